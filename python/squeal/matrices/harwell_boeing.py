# SPDX-License-Identifier: BSD-2-Clause
"""Harwell-Boeing files, in text, and the mapping file of Ansys' command HBMAT.

The header gives the numbers of lines of pointers, row indices, values and right-hand sides, the
type of the matrix, its size and the Fortran formats of the parts. Source: I. Duff, R. Grimes,
J. Lewis, Users' guide for the Harwell-Boeing sparse matrix collection, 1992. HBMAT writes the
types RSA (the lower triangle, by older versions at times all entries) and RUA, the right-hand side
as a last part, and into Fname.mapping a line for each equation: number, node, degree of freedom.
Source: Ansys Mechanical APDL Command Reference, HBMAT.
"""
import re

import numpy as np

from squeal.deck.journal import Fault
from squeal.matrices.coordinate import SKEW, TRIANGLE, WHOLE, Matrix
from squeal.matrices.labels import LARGEST_NODE, component_number, keys_of
from squeal.matrices.text import Lines, integers_of, read_bytes, reals_of

NAME = "Harwell-Boeing"
TYPE = re.compile(r"[RCPI][SUHZR][AE]")
SEPARATED = r"(?:[ \t]+|[ \t]*,[ \t]*)"
FORMAT = re.compile(r"\(((?:(\d+)P,?)?(\d*)([IEDFG])(\d+)(?:\.\d+)?(?:E\d+)?)\)")
REFUSED = {
    "C": "complex entries",
    "P": "a pattern without values",
    "I": "integer entries",
    "H": "Hermitian matrices",
    "R": "rectangular matrices",
    "E": "matrices that are not assembled",
}


def is_header(lines):
    """Returns whether the first lines of a file are those of this format."""
    return len(lines) > 2 and TYPE.match(lines[2].upper()) is not None


def read(path):
    """Returns the matrix of a file. Raises Fault."""
    text = Lines(read_bytes(path))
    if len(text) < 5:
        raise Fault("the file has no header: cut short", line=len(text))
    header = _Header(text)
    pointers, line = _integers(text, header.first, header.size + 1, header.formats[0], header.cards)
    count = int(pointers[-1]) - 1
    steps = np.diff(pointers)
    if pointers[0] != 1 or np.any(steps < 0) or count != header.entries:
        raise Fault(
            "the pointers do not begin with 1, decrease, or do not end with the number of entries",
            line=line,
        )
    rows, line = _integers(text, line, count, header.formats[1], header.cards, 1)
    if count and (rows.min() < 1 or rows.max() > header.size):
        raise Fault("a row is not in the matrix", line=line)
    values, line = _reals(text, line, count, header.formats[2], header.cards, 2)
    columns = np.repeat(np.arange(header.size), steps)
    found = Matrix(NAME, rows - 1, columns, values, header.size, header.form)
    if header.cards[3]:
        line = header.skip_right_hand_sides(text, line)
        found.remarks.append(f"{header.sides} right-hand sides are not used")
    if any(text.text(one).strip() for one in range(line, len(text))):
        raise Fault("lines follow after those of the header's count", line=line + 1)
    return found


class _Header:
    def __init__(self, text):
        whole, *self.cards = _fixed(text, 1, 0, 5, blank=0)
        if sum(self.cards) != whole or min(self.cards) < 0 or self.cards[2] == 0:
            raise Fault("the numbers of lines do not add up, or there are no values", line=2)
        kind = text.text(2)[:3].upper()
        if not TYPE.match(kind):
            raise Fault(f"'{kind}' is not a type of matrix", line=3)
        for letter, allowed in zip(kind, ("R", "SUZ", "A")):
            if letter not in allowed:
                raise Fault(f"{kind}: {REFUSED[letter]} are not supported", line=3)
        self.form = {"S": TRIANGLE, "U": WHOLE, "Z": SKEW}[kind[1]]
        rows, self.size, self.entries, _ = _fixed(text, 2, 14, 4, blank=0)
        if rows != self.size or rows < 1 or self.entries < 0:
            raise Fault(f"{rows} rows, {self.size} columns, {self.entries} entries", line=3)
        line = text.text(3)
        places = (line[:16], line[16:32], line[32:52], line[52:72])
        self.formats = [_Format(one, 4) for one in places[: 4 if self.cards[3] else 3]]
        self.first, self.sides = 4, 0
        if self.cards[3]:
            kind = text.text(4)[:3].upper()
            self.sides = _fixed(text, 4, 14, 1, blank=0)[0]
            if kind[:1] != "F" or kind[1:].strip() or self.sides < 1:
                raise Fault(f"right-hand sides of the type '{kind}' are not supported", line=5)
            self.first = 5

    def skip_right_hand_sides(self, text, line):
        """Checks that they are there, and returns the line after them."""
        form, end = self.formats[3], line + self.cards[3]
        count = self.size * self.sides
        each = -(-self.size // form.per_line) * self.sides
        if self.cards[3] not in (each, -(-count // form.per_line)):
            raise Fault("the right-hand sides do not have the lines of the header's count", line=2)
        if end > len(text):
            raise Fault("the file ends too early: cut short", line=len(text))
        return end


class _Format:
    """A Fortran format of one kind of numbers."""

    def __init__(self, word, line):
        match = FORMAT.fullmatch("".join(word.upper().split()))
        if not match:
            raise Fault(f"'{word.strip()}' is not a format of numbers", line=line)
        self.scaled = match[2] not in (None, "0")
        self.kind = match[4]
        self.per_line, self.width = int(match[3] or 1), int(match[5])
        if not 0 < self.width <= 80 or not 0 < self.per_line <= 200:
            raise Fault(f"'{word.strip()}' is not a format of numbers", line=line)
        if self.scaled and self.kind == "F":
            raise Fault(f"the scale factor of '{word.strip()}' is not supported", line=line)


def _fixed(text, line, offset, count, blank):
    """Returns integers of 14 columns each."""
    fields = np.concatenate(
        [text.fields(np.array([line]), offset + 14 * one, 14) for one in range(count)]
    )
    return [int(one) for one in integers_of(fields, lambda at: line + 1, blank)]


def _integers(text, line, count, form, cards, part=0):
    if form.kind != "I":
        raise Fault("the format of the indices is not one of integers", line=4)
    fields, end = _block(text, line, count, form, cards[part])
    return integers_of(fields, lambda at: line + at // form.per_line + 1), end


def _reals(text, line, count, form, cards, part):
    if form.kind == "I":
        raise Fault("the format of the values is one of integers", line=4)
    fields, end = _block(text, line, count, form, cards[part])
    return reals_of(fields, lambda at: line + at // form.per_line + 1, form.scaled), end


def _block(text, line, count, form, cards):
    if cards != -(-count // form.per_line):
        raise Fault(f"{count} numbers do not fill the {cards} lines that the header gives", line=2)
    return text.block(line, count, form.per_line, form.width)


def read_mapping(path):
    """Returns the keys of the rows by the mapping file of HBMAT. Raises Fault."""
    text = Lines(read_bytes(path))
    integer, word = r"(\d{1,15})", r"(\w+)"
    pattern = re.compile(rf"\s*{SEPARATED.join((integer, integer, word))}[ \t]*")
    keys = []
    for line in range(len(text)):
        words = text.text(line)
        match = pattern.fullmatch(words)
        if not match:
            if words.strip() and (keys or re.match(r"\s*\d", words)):
                shown = words.strip()[:40]
                raise Fault(f"'{shown}' is not equation, node, degree of freedom", line=line + 1)
            continue  # a heading
        component = component_number(match[3])
        if component is None or int(match[2]) >= LARGEST_NODE:
            shown = words.strip()[:40]
            raise Fault(f"'{shown}' has an unknown degree of freedom", line=line + 1)
        if int(match[1]) != len(keys) + 1:
            raise Fault(f"equation {match[1]} follows {len(keys)}", line=line + 1)
        keys.append(keys_of(int(match[2]), component))
    return np.array(keys, np.int64)
