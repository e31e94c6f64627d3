# SPDX-License-Identifier: BSD-2-Clause
"""Reads OP4 files in text: integers of 8 columns, values in the format of the header."""
import re

import numpy as np

from squeal.deck.journal import Fault
from squeal.matrices.op4 import Header, Strings, chosen
from squeal.matrices.text import Lines, read_bytes, reals_of

FORMAT = re.compile(r"(?:(\d+)P,?)?(\d+)[ED](\d+)\.\d+(?:E\d+)?")
# Lines of integers by their number: columns of 8, or a single one of up to 12.
INTEGERS = {1: re.compile(rb"([ \d-]{1,12}) *\r?\n")}
INTEGERS |= {count: re.compile(rb"([ \d-]{8})" * count + rb" *\r?\n") for count in (2, 3)}


def is_header(line):
    """Returns whether a line is a header of this format."""
    words = [line[at : at + 8] for at in range(0, 32, 8)]
    integers = all(re.fullmatch(r" *-?\d+ *", word) for word in words)
    name = r" *\w+ *" if "E" in line[40:] else r" *[A-Za-z]\w* *"  # a fifth integer otherwise
    return integers and re.fullmatch(name, line[32:40].ljust(8)) is not None


def read(path, wanted):
    """Returns the matrix of a name. Raises Fault."""
    text = Lines(read_bytes(path))
    headers, line = [], 0
    while line < len(text):
        if not text.text(line).strip():
            line += 1
            continue
        one = _Reader(text, line)
        headers.append(one)
        line = one.skip()
    at = chosen([one.header for one in headers], wanted)
    headers[at].header.require_supported(headers[at].line + 1)
    others = [one.header.name for one in headers if one is not headers[at]]
    return headers[at].matrix(others)


class _Reader:
    """One matrix of a file; `line`: that of its header."""

    def __init__(self, text, line):
        self.text, self.line = text, line
        words = text.text(line)
        if not is_header(words):
            raise Fault(f"'{words.strip()[:40]}' is not a header of a matrix", line=line + 1)
        numbers = [int(words[at : at + 8]) for at in range(0, 32, 8)]
        self.header = Header(*numbers, words[32:40].strip().upper())
        self.header.require_plausible(line + 1)
        form = "".join(words[40:].upper().split()) or "1P,5E16.9"
        match = FORMAT.fullmatch(form)
        if not match or not 0 < int(match[3]) <= 80 or not 0 < int(match[2]) <= 200:
            raise Fault(f"'{form[:40]}' is not a format of numbers", line=line + 1)
        self.scaled = match[1] not in (None, "0")
        self.per_line, self.width = int(match[2]), int(match[3])
        self.strings = Strings(self.header)

    def skip(self):
        """Finds the strings of the matrix, and returns the line after it."""
        line = self.line + 1
        while True:
            column, row, words = self._integers(line, 3)
            if column > self.header.columns:
                break
            self.strings.begin_column(column, line + 1)
            if words < 1:
                raise Fault(f"column {column} has {words} words", line=line + 1)
            if row > 0:
                line = self._add(line + 1, self._count(line + 1, words), row)
            else:
                line = self._sparse(line + 1, words)
        if column != self.header.columns + 1:
            raise Fault(f"column {column} of {self.header.columns}", line=line + 1)
        self._value(line + 1)
        return line + 2

    def _count(self, line, words):
        """Returns the number of values of a dense column. NW counts words by the guide, two for a
        number of double precision, but other writers count numbers; the last line decides."""
        if self.header.type in (2, 4) and words % 2 == 0:
            count = words // 2
            last = line + -(-count // self.per_line) - 1
            filled = (count - 1) % self.per_line + 1
            if last + 1 < len(self.text) and "." not in self.text.text(last + 1):
                if len(self.text.text(last).rstrip()) == filled * self.width:
                    return count
        return words

    def _sparse(self, line, words):
        per_value = 2 if self.header.type % 2 == 0 else 1
        while words > 0:
            if self.header.wide:
                length, row = self._integers(line, 2)
                length -= 1
                words -= length + 2
            else:
                (packed,) = self._integers(line, 1)
                length, row = packed // 65536 - 1, packed % 65536
                words -= length + 1
            if length < 1 or length % per_value or words < 0:
                raise Fault("a string of entries does not fit into its column", line=line + 1)
            line = self._add(line + 1, length // per_value, row)
        return line

    def _add(self, line, count, row):
        parts = 2 if self.header.type > 2 else 1
        self.strings.add(line, -(-count // parts), row, line)
        return line + -(-count // self.per_line)

    def _integers(self, line, count):
        if line >= len(self.text):
            raise Fault("the file ends within a matrix: cut short", line=len(self.text))
        match = INTEGERS[count].match(self.text.data, self.text.starts[line])
        try:
            return [int(one) for one in match.groups()]
        except (AttributeError, ValueError):  # no match, or blanks within a number
            shown = self.text.text(line).strip()[:40]
            raise Fault(f"'{shown}' is not {count} integer numbers", line=line + 1) from None

    def _value(self, line):
        """Requires the value that follows the last record."""
        if line >= len(self.text):
            raise Fault("the file ends within a matrix: cut short", line=len(self.text))
        reals_of(self.text.fields(np.array([line]), 0, self.width), lambda at: line + 1)
        self.text.require_lengths(np.array([line]), self.width)

    def matrix(self, others):
        string, within = self.strings.within()
        lines = np.array(self.strings.places, np.int64)[string] + within // self.per_line
        if len(lines) and lines.max() >= len(self.text):
            raise Fault("the file ends within a matrix: cut short", line=len(self.text))
        places = within % self.per_line
        last = np.flatnonzero(np.append(lines[1:] != lines[:-1], True)[: len(lines)])
        self.text.require_lengths(lines[last], (places[last] + 1) * self.width)
        fields = self.text.fields(lines, places * self.width, self.width)
        values = reals_of(fields, lambda at: int(lines[at]) + 1, self.scaled)
        return self.strings.matrix(string, within, values, others)
