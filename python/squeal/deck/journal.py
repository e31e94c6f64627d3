# SPDX-License-Identifier: BSD-2-Clause
"""The account of a deck: what becomes of each card, and the choices made on the way.

Every card has one entry. At the end it is used, translated, not used or refused; a card without a
mark is an error of the reader, and the journal refuses it.
"""
from dataclasses import dataclass, field

from squeal.files import ResultsError

USED, TRANSLATED, UNUSED, REFUSED = "used", "translated", "not used", "refused"
SHOWN = 100  # refused lines of one card that a message lists
ORDER = (USED, UNUSED, TRANSLATED, REFUSED)  # a later word replaces an earlier one


class DeckError(ResultsError):
    """A deck that cannot be translated; the message lists all refused cards with their lines."""


class Fault(Exception):
    """A card that cannot be honoured: `name` is that for --ignore, `line` a line of its data."""

    def __init__(self, reason, name=None, line=None):
        super().__init__(reason)
        self.reason, self.name, self.line = reason, name, line


class LineOfFile(int):
    """The number of a line of data in another file than the keyword line of its card."""

    def __new__(cls, number, file):
        one = super().__new__(cls, number)
        one.file = file
        return one


class Missing(Fault):
    """Something that the deck refers to and that was not translated."""


@dataclass(frozen=True)
class Source:
    """A card's place: file as it is shown, line, and keyword; `star` precedes keywords."""

    file: str
    line: int
    card: str
    star: str = "*"

    def __str__(self):
        return f"{self.file}:{self.line}"

    @property
    def word(self):
        return f"{self.star}{self.card}"


def place_of(source, line):
    """Returns file and number of a line of data of a card."""
    return f"{getattr(line, 'file', source.file)}:{line}"


@dataclass
class Entry:
    source: Source
    status: str = ""
    remarks: list = field(default_factory=list)


@dataclass(frozen=True)
class Refusal:
    source: Source
    line: int
    name: str
    reason: str

    def __str__(self):
        if not self.source.card:
            return f"{self.source.file}: {self.reason}"
        subject = self.source.word
        if self.name != self.source.card:
            subject += f", {self.name}"
        return f"{place_of(self.source, self.line)}: {subject}: {self.reason}"


class Journal:
    """`ignored`: names of cards, parameters or element types that are passed over with a remark
    where they would be refused."""

    def __init__(self, ignored=()):
        self.ignored = {"".join(name.upper().split()).lstrip("*"): name for name in ignored}
        self.met = set()
        self.entries = {}
        self.choices = []
        self.incomplete = False  # elements were refused, which are missing afterwards
        self.refusals = []
        self._refused = set()

    def open(self, source):
        self.entries.setdefault(source, Entry(source))

    def mark(self, source, status, remark=""):
        entry = self.entries.setdefault(source, Entry(source))
        if not entry.status or ORDER.index(status) > ORDER.index(entry.status):
            entry.status = status
        if remark and remark not in entry.remarks:
            entry.remarks.append(remark)

    def remark(self, source, text):
        entry = self.entries.setdefault(source, Entry(source))
        if text not in entry.remarks:
            entry.remarks.append(text)

    def ignores(self, name):
        """Returns whether a name is to be passed over; names are compared without blanks."""
        key = "".join(name.upper().split())
        if key in self.ignored:
            self.met.add(key)
        return key in self.ignored

    def refuse(self, source, reason, name=None, line=None):
        """Returns whether the card is refused, and not ignored."""
        name = name or source.card
        if self.ignores(name):
            self.mark(source, UNUSED, f"ignored by --ignore {name}: {reason}")
            return False
        self.mark(source, REFUSED, reason)
        refusal = Refusal(source, line or source.line, name, reason)
        if refusal not in self._refused:
            self._refused.add(refusal)
            self.refusals.append(refusal)
        return True

    def refuse_fault(self, source, fault):
        """Refuses a card because of a fault, unless that follows from refused elements."""
        if not (isinstance(fault, Missing) and self.incomplete):
            self.refuse(source, fault.reason, fault.name, fault.line)

    def refuse_model(self, reason):
        """Refuses a deck for a reason that belongs to no single card."""
        self.refuse(Source("the model", 0, ""), reason)

    def choose(self, text):
        """Notes a choice between several readings of the deck."""
        if text not in self.choices:
            self.choices.append(text)

    def close(self):
        """Refuses cards without a mark. To be called when the reader has ended."""
        for entry in self.entries.values():
            if not entry.status:
                self.refuse(entry.source, "the reader did not account for this card")

    def counted(self):
        """Returns the numbers of cards by outcome, as words."""
        counts = dict.fromkeys((USED, TRANSLATED, UNUSED, REFUSED), 0)
        for entry in self.entries.values():
            counts[entry.status] += bool(entry.source.card)
        return ", ".join(f"{count} {status}" for status, count in counts.items() if count)

    def unmet(self):
        """Returns the names of --ignore that met nothing."""
        return [name for key, name in self.ignored.items() if key not in self.met]

    def require_translatable(self, title):
        """Raises DeckError with all refusals, in the order of the deck."""
        if not self.refusals:
            return
        place = {source: number for number, source in enumerate(self.entries)}
        ordered = sorted(self.refusals, key=lambda one: (place[one.source], one.line))
        count = len({one.source for one in ordered})
        cards = "1 card" if count == 1 else f"{count} cards"
        rows, counts = [], {}
        for one in ordered:
            counts[one.source] = counts.get(one.source, 0) + 1
            if counts[one.source] <= SHOWN:
                rows.append(f"  {one}")
        for source, number in counts.items():
            if number > SHOWN:
                rows.append(f"  {source}: {source.word}: {number - SHOWN} more lines")
        raise DeckError("\n".join([f"{title} cannot be translated because of {cards}:", *rows]))
