# SPDX-License-Identifier: BSD-2-Clause
"""Cards of a deck: keyword, parameters and lines of data."""
import re
from dataclasses import dataclass, field

from squeal.deck.inp.dialect import NAMES
from squeal.deck.journal import Fault, LineOfFile, Source

FLAGS = {"GENERATE", "NLGEOM", "PERTURBATION", "FIXED", "SUBMODEL", "DIRECT", "INTERNAL"}


@dataclass
class Card:
    """`parameters`: values by upper-case name, None for a name without a value; `data`: number of
    the line and text."""

    keyword: str
    source: Source
    parameters: dict
    dialect: object
    known: bool = True
    data: list = field(default_factory=list)

    def rows(self):
        """Yields number and fields of each line of data."""
        for number, text in self.data:
            yield number, fields_of(text)

    def value(self, name):
        """Returns the value of a parameter as written, without quotes, or None. Raises Fault if it
        is empty."""
        if name not in self.parameters:
            return None
        text = self.parameters[name]
        if not text:
            raise Fault(f"{name}= has no value")
        return unquoted(text)

    def require(self, name):
        value = self.value(name)
        if value is None:
            raise Fault(f"{name}= is missing")
        return value

    def key(self, name, default=None):
        """Returns the key of a parameter's value. Raises Fault if it is empty, or missing without a
        default."""
        if default is not None and name not in self.parameters:
            return default
        self.require(name)
        return key_of(self.parameters[name])


def fields_of(text):
    """Returns the fields of a line of data; a comma at its end adds none."""
    if '"' in text:
        outside = re.split(r'("[^"]*")', text)
        outside[::2] = [part.replace(",", "\n") for part in outside[::2]]
        fields = [part.strip() for part in "".join(outside).split("\n")]
    else:
        fields = [part.strip() for part in text.split(",")]
    if len(fields) > 1 and fields[-1] == "":
        fields.pop()
    return fields


def unquoted(text):
    text = text.strip()
    return text[1:-1] if len(text) > 1 and text[0] == text[-1] == '"' else text


def key_of(name):
    """Returns the name by which sets, materials and the like are found: without case, and without
    blanks unless they are quoted; "Part 1".TOP has the quoted name of an instance."""
    parts = name.strip().upper().split('"')
    parts[::2] = ["".join(part.split()) for part in parts[::2]]
    return "".join(parts)


def read_cards(lines, dialect, journal):
    """Returns the cards of lines. Refuses lines that belong to no card."""
    cards, position = [], 0
    add, own = None, ""  # of the last card: appends a line, and its file
    while position < len(lines):
        file, number, text = line = lines[position]
        position += 1
        if text[0] == "*":
            text, position = _continued(lines, position, text, dialect, journal)
            cards.append(_card(line, text, dialect, journal))
            journal.open(cards[-1].source)
            add, own = cards[-1].data.append, file
        elif add:
            add((number if file == own else LineOfFile(number, file), text))
        else:
            source = Source(file, number, "(no card)")
            journal.refuse(source, "a line of data before the first card")
    return cards


def _continued(lines, position, text, dialect, journal):
    """Joins a keyword line that ends with a comma with the next line, if that holds parameters."""
    while text.endswith(",") and position < len(lines):
        line = lines[position]
        first = line.text.split(",")[0].strip().upper()
        if line.text.startswith("*"):
            break
        if "=" not in line.text and first not in FLAGS:
            journal.choose(
                f"{line.file}:{line.number}: read as data, although the keyword line before it ends"
                " with a comma"
            )
            break
        if not dialect.continued_keywords:
            journal.choose(
                f"{line.file}:{line.number}: read as a continuation of the keyword line, which"
                " CalculiX does not know"
            )
        text += line.text
        position += 1
    return text, position


def _card(line, text, dialect, journal):
    words = fields_of(text[1:])
    keyword, known, written = keyword_of(words[0])
    source = Source(line.file, line.number, keyword)
    if known and written and not dialect.short_words:
        journal.choose(
            f"{source}: *{written} is read as *{keyword}; CalculiX does not know short words"
        )
    parameters = {}
    for word in words[1:]:
        if not word:
            continue  # two commas in sequence
        name, equals, value = word.partition("=")
        name = " ".join(name.upper().split())
        parameters[name] = value.strip() if equals else None
    return Card(keyword, source, parameters, dialect, known)


def keyword_of(text):
    """Returns the keyword of a card, whether it is known, and the written one if it is short."""
    words = " ".join(text.upper().split())
    key = words.replace(" ", "")
    if key in NAMES:
        return NAMES[key], True, ""
    longer = [name for short, name in NAMES.items() if short.startswith(key)]
    if len(key) >= 3 and len(longer) == 1:
        return longer[0], True, words
    return words, False, ""
