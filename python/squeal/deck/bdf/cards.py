# SPDX-License-Identifier: BSD-2-Clause
"""Cards of bulk data, with the lines that continue them.

A line that continues a card follows it, or has its marker. Successive cards of the names in BLOCKS
share one entry in the journal.
"""
from dataclasses import dataclass, field

import numpy as np

from squeal.deck.bdf.fields import DATA, LAST, WIDTH, head_of, joined, marker_of
from squeal.deck.journal import Fault, Source
from squeal.deck.numbers import integer, real

REQUIRED = object()
CHUNK = 20000  # cards that are converted together


@dataclass
class Card:
    """`fields`: data in the order of the card, counted from 1; a field that nothing reads is
    refused."""

    name: str
    source: Source
    line: int
    fields: list
    read: set = field(default_factory=set)
    passed: list = field(default_factory=list)  # places of fields that are not used

    def word(self, number, default=""):
        """Returns a field in capital letters, or the default if it is blank."""
        self.read.add(number)
        text = self.fields[number - 1] if number <= len(self.fields) else ""
        return text.upper() if text else default

    def pass_over(self, number):
        """Names a field as not used, if there is one."""
        if self.word(number):
            self.passed.append(self.place(number))

    def _value(self, number, default, convert):
        text = self.word(number)
        if text:
            try:
                return convert(text)
            except Fault as fault:
                raise Fault(f"field {self.place(number)}: {fault.reason}", line=self.line) from None
        if default is REQUIRED:
            raise Fault(f"field {self.place(number)} is blank", line=self.line)
        return default

    def integer(self, number, default=REQUIRED):
        return self._value(number, default, integer)

    def real(self, number, default=REQUIRED):
        return self._value(number, default, real)

    def reals(self, first, count, default=REQUIRED):
        return [self.real(number, default) for number in range(first, first + count)]

    def identifier(self, number, default=REQUIRED):
        """Returns the number of a grid, an element, a set and the like."""
        value = self.integer(number, default)
        if value is not default and value < 1:
            raise Fault(f"field {self.place(number)}: {value} is not positive", line=self.line)
        return value

    def components(self, number, default=REQUIRED):
        """Returns components from 0 to 5, given by digits. Raises Fault."""
        text = self.word(number)
        if not text and default is not REQUIRED:
            return default
        if not text or set(text) - set("123456") or len(set(text)) < len(text):
            reason = f"field {self.place(number)}: '{text}' are not components, some of 123456"
            raise Fault(reason, line=self.line)
        return tuple(sorted(int(letter) - 1 for letter in text))

    def place(self, number):
        """Returns the words for the place of a field: that in its line, and its line."""
        row, column = divmod(number - 1, DATA)
        return f"{column + 2} of line {row + 1}" if row else f"{column + 2}"

    def numbers(self, first):
        """Returns the grids or elements listed from a field on, as given (first, last) ranges."""
        return self.numbers_of(first, len(self.fields))

    def numbers_of(self, first, last):
        """The same for the fields up to `last`."""
        ranges, number = [], first
        while number <= last:
            if not self.word(number):
                number += 1
                continue
            start = self.identifier(number)
            if self.word(number + 1) == "THRU":
                end = self.identifier(number + 2)
                if end < start:
                    raise Fault(f"the range {start} THRU {end} is empty", line=self.line)
                ranges.append((start, end))
                number += 3
            else:
                ranges.append((start, start))
                number += 1
        return ranges

    def unread(self):
        """Raises Fault for a field that nothing has read."""
        for number, text in enumerate(self.fields, 1):
            if text and number not in self.read:
                raise Fault(
                    f"field {self.place(number)}, '{text}', is not supported", None, self.line
                )


class Deck:
    """The cards of the bulk data by name, in their order."""

    def __init__(self, lines, journal, blocks):
        """`blocks`: names of cards that share the entry of the first one in sequence."""
        self.lines, self.journal = lines, journal
        self.chains = {}  # name -> places of the lines of each card
        self.sources = {}  # name -> (number of the first card with it, source) of each entry
        self._long = []
        last, counts = None, []
        one_file = lines.files[0] if len(lines.files) == 1 else None
        for head, chain in self._assemble():
            at = chain[0]
            name = head.rstrip("*").rstrip().upper()
            known = self.chains.setdefault(name, [])
            file = one_file or lines.file(at)
            if last is None or last.card != name or last.file != file or name not in blocks:
                last = lines.source(at, name)
                journal.open(last)
                self.sources.setdefault(name, []).append((len(known), last))
                counts.append([last, 0])
            known.append(chain)
            counts[-1][1] += 1
        for source, count in counts:
            if count > 1:
                journal.remark(source, f"{count} cards in sequence")
        self._name_long()

    def rows(self, name, first=0, count=None):
        """Yields fields of data, line and source of each card of a name, or of some of them.
        Refuses cards with fields that have no place."""
        texts, numbers = self.lines.texts, self.lines.numbers
        sources = self.sources.get(name, [])
        chains = self.chains.get(name, [])
        last = len(chains) if count is None else first + count
        entry, source = 0, None
        for number, chain in enumerate(chains[first:last], first):
            while entry < len(sources) and sources[entry][0] <= number:
                source = sources[entry][1]
                entry += 1
            try:
                fields = joined([texts[at] for at in chain], [numbers[at] for at in chain])
            except Fault as fault:
                self.journal.refuse(source, fault.reason, line=fault.line)
            else:
                yield fields, numbers[chain[0]], source

    def tables(self, name):
        """Yields for blocks of cards of a name the fields of data, a row of bytes without blanks
        for each card, or None for a block that needs a closer look, with its first card and their
        number."""
        chains = self.chains.get(name, [])
        for first in range(0, len(chains), CHUNK):
            some = chains[first : first + CHUNK]
            yield self._table(some), first, len(some)

    def _table(self, chains):
        """Returns the fields of cards that have small fields on equal numbers of lines."""
        size = len(chains[0])
        if any(len(chain) != size for chain in chains):
            return None
        texts = self.lines.texts
        whole = "".join([texts[at].ljust(LAST)[:LAST] for chain in chains for at in chain])
        if not whole.isascii() or "," in whole or "*" in whole or "_" in whole:
            return None
        fields = np.frombuffer(whole.encode("ascii"), f"S{WIDTH}")
        fields = fields.reshape(len(chains) * size, DATA + 1)[:, 1:]
        return np.char.strip(fields.reshape(len(chains), size * DATA))

    def each(self, name):
        """Yields the cards of a name."""
        for fields, line, source in self.rows(name):
            yield Card(name, source, line, fields)

    def _assemble(self):
        """Returns the first field of each card and the places of its lines."""
        chains, heads, loose = [], [], {}
        nameless = {"replicated cards": [], "a card without a name": []}
        chain, marker = None, ""
        for at, text in enumerate(self.lines.texts):
            length = len(text)
            if length > LAST + WIDTH and "," not in text:
                self._long.append(at)
            head = head_of(text)
            if head and head[0].isalpha():
                chain = [at]
                chains.append(chain)
                heads.append(head)
            elif head and head[0] not in "+*":
                if chain is None or not self._goes_on(at, chain[-1]):
                    nameless["replicated cards" if head[0] == "=" else "a card without a name"] += [
                        at
                    ]
                    continue
                chain.append(at)
            else:
                key = head[1:].strip()
                if chain is not None and key in ("", marker):
                    chain.append(at)
                elif not key or key in loose:
                    what = f"a second line with the marker {key}" if key else "without a card"
                    self._refuse(at, f"a continuation, {what},")
                    continue
                else:
                    before, chain = chain, [at]
                    loose[key] = chain, before
            marker = marker_of(text) if length > LAST or "," in text else ""
        self._attach(chains, loose)
        for what, places in nameless.items():
            if places:
                more = f" ({len(places)} lines)" if len(places) > 1 else ""
                self._refuse(places[0], f"{what}{more}")
        return zip(heads, chains)

    def _goes_on(self, at, before):
        """Returns whether a free-field line without a marker continues one that ends with a comma;
        then gives it an empty first field."""
        texts = self.lines.texts
        if "," not in texts[at] or not texts[before].endswith(",") or before != at - 1:
            return False
        texts[at] = f",{texts[at].lstrip()}"
        self.journal.choose(
            f"{self.lines.source(at, '')}: continues the line before it, which ends with a comma"
        )
        return True

    def _attach(self, chains, loose):
        """Gives lines that are apart from their card to the line with their marker; without one, to
        the line before them if that has no marker itself."""
        texts = self.lines.texts
        for chain in chains if loose else ():
            while marker_of(texts[chain[-1]]) in loose:
                lines, _ = loose.pop(marker_of(texts[chain[-1]]))
                self.journal.choose(
                    f"{self.lines.source(lines[0], '')}: continues the card of line"
                    f" {self.lines.numbers[chain[0]]}, which has its marker"
                )
                chain.extend(lines)
        for key, (lines, before) in loose.items():
            if before is None or marker_of(texts[before[-1]]):
                self._refuse(lines[0], f"a continuation, whose marker {key} no card has,")
            else:
                self.journal.choose(
                    f"{self.lines.source(lines[0], '')}: continues the card before it, which has no"
                    " marker"
                )
                before.extend(lines)

    def _refuse(self, at, what):
        self.journal.refuse(self.lines.source(at, "(no card)"), f"{what} is not supported")

    def _name_long(self):
        if self._long:
            self.journal.choose(
                f"{self.lines.source(self._long[0], '')}: columns after 80 are not read, in"
                f" {len(self._long)} lines"
            )
