# SPDX-License-Identifier: BSD-2-Clause
"""Lines of a Nastran deck, with those of included files in their place, by section.

A dollar sign begins a comment; a tab ends its field of eight columns.
"""
import bisect
import re
from dataclasses import dataclass, field
from pathlib import Path

from squeal.deck.journal import DeckError, Source
from squeal.deck.texts import find_included, read_texts

LONGEST = 256  # lines of a quoted name of a file
BULK = re.compile(r"BEGIN\s+BULK\s*$", re.IGNORECASE)
# Words that begin a deck with an executive section, though its BEGIN BULK may be missing.
EXECUTIVE = re.compile(r"(SOL\s+\w|CEND\s*$|SUBCASE\s+\d)", re.IGNORECASE)


@dataclass
class Lines:
    """Texts without comments and blanks at their ends, with the numbers of their lines; `starts`
    are the places in `texts` where another file begins, `files` their names."""

    texts: list = field(default_factory=list)
    numbers: list = field(default_factory=list)
    starts: list = field(default_factory=list)
    files: list = field(default_factory=list)

    def begin(self, file):
        """The next lines belong to this file."""
        if not self.files or self.files[-1] != file:
            self.starts.append(len(self.texts))
            self.files.append(file)

    def file(self, at):
        return self.files[bisect.bisect_right(self.starts, at) - 1]

    def part(self, first, last):
        """Returns the lines of a range."""
        one = Lines(self.texts[first:last], self.numbers[first:last])
        for start, end, file in zip(self.starts, [*self.starts[1:], len(self.texts)], self.files):
            if start < last and end > first:
                one.starts.append(max(start - first, 0))
                one.files.append(file)
        return one

    def source(self, at, card):
        return Source(self.file(at), self.numbers[at], card, "")


def without_comment(text):
    """Returns a line without its comment; a dollar sign between quotes is none."""
    if "$" not in text:
        return text
    if "'" not in text:
        return text[: text.index("$")]
    parts = re.match(r"(?:[^$']|'[^']*'?)*", text)
    return parts[0]


class Gathering:
    """Joins the files of a deck."""

    def __init__(self, path, journal):
        self.root = Path(path)
        self.journal = journal
        self.lines = Lines()
        self.end = None  # ENDDATA
        self._file(self.root, " ".join(self.root.name.split()), ())

    def _file(self, path, name, above):
        texts = read_texts(path, name, self.journal)
        add_text, add_number = self.lines.texts.append, self.lines.numbers.append
        at, begun = 0, False
        while at < len(texts) and self.end is None:
            text = texts[at]
            at += 1
            if "$" in text:
                text = without_comment(text)
            text = text.rstrip()
            if "\t" in text:
                text = text.expandtabs(8).rstrip()
            if not text:
                continue
            if text.lstrip()[0] in "IiEe":
                first = text.lstrip()[:8].upper()
                if first.startswith("INCLUDE") and not first[7:].strip(" '\"="):
                    at, begun = self._included(texts, at, text, path, name, above), False
                    continue
                if first.startswith("ENDDATA"):
                    self._name_rest(name, at, texts, above)
                    continue
            if not begun:
                self.lines.begin(name)
                begun = True
            add_text(text)
            add_number(at)

    def _name_rest(self, name, number, texts, above):
        source = self.end = Source(name, number, "ENDDATA", "")
        rest = sum(1 for text in texts[number:] if without_comment(text).strip())
        if rest:
            self.journal.choose(f"{source}: {rest} lines after ENDDATA are not read")
        if above:
            self.journal.choose(f"{source}: ENDDATA in an included file ends the whole deck")

    def _included(self, texts, at, text, path, name, above):
        """Reads a file in place of its card, whose quoted name may go on in the next lines; returns
        the place of the line after it."""
        source = Source(name, at, "INCLUDE", "")
        self.journal.open(source)
        rest = text.strip()[7:].strip(" =")
        quote = rest[:1] if rest[:1] in ("'", '"') else ""
        if quote:
            word, last = rest[1:], at
            while quote not in word and last < min(len(texts), at + LONGEST):
                word += texts[last].strip()
                last += 1
            if quote not in word:
                self.journal.refuse(source, "the quoted name of the file does not end")
                return at
            word, at = word[: word.index(quote)], last
        else:
            word = rest
        word = word.strip()
        if not word:
            self.journal.refuse(source, "no file is named")
            return at
        if "\\" in word and not (path.parent / word).is_file():
            word = word.replace("\\", "/")
        found = find_included(word, path, self.root, (*above, path), self.journal, source)
        if found is not None:
            self._file(found, word, (*above, path))
        return at


def read_sections(path, journal):
    """Returns the lines of executive and case control (one list), those of the bulk data, and the
    sources of the lines between them and at the end. A deck without BEGIN BULK has only bulk data.
    Raises DeckError if its file cannot be read."""
    try:
        whole = Gathering(path, journal)
    except OSError as error:
        raise DeckError(f"{error.filename or path}: {error.strerror}") from None
    lines, marks = whole.lines, [whole.end] if whole.end else []
    begins = [
        at
        for at, text in enumerate(lines.texts)
        if ("B" in text or "b" in text) and text.lstrip()[:6].upper().rstrip() == "BEGIN"
    ]
    for at in begins:
        source = lines.source(at, "BEGIN BULK")
        if BULK.match(lines.texts[at].strip()) and at == begins[0]:
            marks.append(source)
        else:
            journal.refuse(source, "superelements, modules and a second BEGIN BULK are refused")
    start = begins[0] if begins else -1
    if not begins:
        bare = next((at for at, text in enumerate(lines.texts) if EXECUTIVE.match(text)), None)
        if bare is not None:
            source = lines.source(bare, lines.texts[bare].split()[0].upper())
            journal.refuse(source, "BEGIN BULK is missing")
            return lines, Lines(), marks
    return lines.part(0, max(start, 0)), lines.part(start + 1, len(lines.texts)), marks
