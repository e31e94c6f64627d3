# SPDX-License-Identifier: BSD-2-Clause
"""Lines of a deck, with those of included files in their place."""
import re
from pathlib import Path
from typing import NamedTuple

from squeal.deck.journal import DeckError, Source
from squeal.deck.texts import find_included, read_texts


class Line(NamedTuple):
    """A tuple, since there are millions."""

    file: str
    number: int
    text: str


# Cards whose lines of data may be in another file.
WITH_INPUT = re.compile(r"\*\s*(NODE|ELEMENT|NSET|ELSET)\s*,(.*,)?\s*INPUT\s*=", re.IGNORECASE)


INCLUDE = re.compile(r"\*\s*INCLUDE\s*(,|$)", re.IGNORECASE)


class Gathering:
    """The `lines` of a deck. Comments (two stars after blanks) and blank lines are omitted; the
    texts have no blanks at their ends."""

    def __init__(self, path, journal):
        self.root = Path(path)
        self.journal = journal
        self.lines = []
        self._file(self.root, " ".join(self.root.name.split()), ())

    def _file(self, path, name, above):
        add = self.lines.append
        for number, text in enumerate(read_texts(path, name, self.journal), 1):
            text = text.strip()
            if text[:1] != "*":
                if text:
                    add(Line(name, number, text))
            elif text[:2] != "**":
                line = Line(name, number, text)
                include = INCLUDE.match(text)
                if not include:
                    add(line)
                if include or WITH_INPUT.match(text):
                    self._included(line, path, (*above, path))

    def _included(self, line, path, above):
        keyword = re.match(r"\*\s*(\w+)", line.text)[1].upper()
        source = Source(line.file, line.number, keyword)
        self.journal.open(source)
        match = re.search(r"INPUT\s*=\s*(\"([^\"]*)\"|[^,]*)", line.text, re.IGNORECASE)
        name = (match[2] if match[2] is not None else match[1]).strip() if match else ""
        if not name:
            self.journal.refuse(source, "INPUT= names no file")
            return
        found = find_included(name, path, self.root, above, self.journal, source)
        if found is not None:
            self._file(found, name, above)


def read_lines(path, journal):
    """Returns the lines of a deck. Raises DeckError if its file cannot be read."""
    try:
        return Gathering(path, journal).lines
    except OSError as error:
        raise DeckError(f"{error.filename or path}: {error.strerror}") from None
