# SPDX-License-Identifier: BSD-2-Clause
"""Matrices of Nastran's OUTPUT4 (.op4), in text (op4_text.py) or binary (op4_binary.py).

A header gives columns, rows, form, type and name. A column follows as a record with its number, its
first row and its number of words: dense from the first to the last entry, or as strings of entries,
each with its own first row. The record of a column beyond the last ends the matrix. There are two
ways to pack length and first row of a string; a negative number of rows, or one above 65535,
stands for the wider one ("bigmat"). Sources: NX Nastran DMAP Programmer's Guide, OUTPUT4; for
words of 8 bytes and the layout of strings in text, the documentation of pyYeti's reader.
"""
from dataclasses import dataclass

import numpy as np

from squeal.deck.journal import Fault
from squeal.matrices.coordinate import TRIANGLE, WHOLE, Matrix

NAME = "Nastran OP4"
BIGMAT = 65536
FORMS = {1: WHOLE, 2: WHOLE, 6: TRIANGLE}
REFUSED_FORMS = {3: "diagonal", 4: "lower triangular factor", 5: "upper triangular factor"}
REFUSED_FORMS |= {8: "identity"}


@dataclass
class Header:
    columns: int
    rows: int
    form: int
    type: int
    name: str

    @property
    def wide(self):
        return self.rows < 0 or self.rows >= BIGMAT

    def require_plausible(self, line=None):
        """Raises Fault if these are not the numbers of a header."""
        if not (0 < self.columns < 2**31 and 0 < abs(self.rows) < 2**31 and 0 < self.form < 16):
            raise Fault(f"no header of a matrix: {self.columns} columns, {self.rows} rows", line)
        if self.type not in (1, 2, 3, 4):
            raise Fault(f"{self.name}: the type {self.type} is not one of Nastran", line=line)

    def require_supported(self, line=None):
        """Raises Fault if this matrix cannot be imported."""
        if self.type > 2:
            raise Fault(f"{self.name}: complex matrices are not supported", line=line)
        if self.form not in FORMS:
            words = REFUSED_FORMS.get(self.form, f"number {self.form}")
            raise Fault(
                f"{self.name}: the form '{words}' is not supported; write it as square (form 1)",
                line=line,
            )
        if abs(self.rows) != self.columns:
            raise Fault(f"{self.name}: {abs(self.rows)} rows, {self.columns} columns", line=line)


class Strings:
    """Runs of entries in columns: places of the first value in the file, lengths, rows, columns."""

    def __init__(self, header):
        self.header = header
        self.places, self.counts, self.rows, self.columns = [], [], [], []
        self.column = 0

    def begin_column(self, column, line=None):
        if not self.column < column:
            raise Fault(f"column {column} follows {self.column}", line=line)
        self.column = column

    def add(self, place, count, row, line=None):
        """`row`: from 1."""
        if count < 1 or row < 1 or row + count - 1 > abs(self.header.rows):
            raise Fault(
                f"{self.header.name}, column {self.column}: {count} entries from row {row} on are"
                f" not in a matrix of {abs(self.header.rows)} rows",
                line=line,
            )
        self.places.append(place)
        self.counts.append(count)
        self.rows.append(row - 1)
        self.columns.append(self.column - 1)

    def within(self):
        """Returns for each entry the number of its string and its place there."""
        counts = np.array(self.counts, np.int64)
        string = np.repeat(np.arange(len(counts)), counts)
        return string, np.arange(len(string)) - (np.cumsum(counts) - counts)[string]

    def matrix(self, string, within, values, others):
        """`others`: names of the other matrices of the file."""
        header = self.header
        rows = np.array(self.rows, np.int64)[string] + within
        columns = np.array(self.columns, np.int64)[string]
        found = Matrix(NAME, rows, columns, values, header.columns, FORMS[header.form], header.name)
        if others:
            found.remarks.append(f"other matrices of the file are not used: {', '.join(others)}")
        return found


def chosen(headers, wanted):
    """Returns which of the headers of a file is wanted. `wanted`: a name, or an empty string if the
    file has only one. Raises Fault."""
    names = [header.name for header in headers]
    if not names:
        raise Fault("the file has no matrix")
    if not wanted and len(names) > 1:
        listed = ", ".join(names)
        raise Fault(f"the file has {len(names)} matrices; give one as FILE:NAME: {listed}")
    wanted, _, number = wanted.upper().partition("#")
    places = [at for at, name in enumerate(names) if not wanted or name == wanted]
    if not places:
        raise Fault(f"the file has no matrix {wanted}; it has {', '.join(names)}")
    if number.isdecimal() and 0 < int(number) <= len(places):
        return places[int(number) - 1]
    if len(places) > 1 or number:
        hint = f"; give one as FILE:{wanted}#1 and so on"
        raise Fault(f"the file has {len(places)} matrices {wanted}{hint}")
    return places[0]
