# SPDX-License-Identifier: BSD-2-Clause
"""Matrices as lists of entries, and their assembly into sparse matrices sorted by rows."""
from dataclasses import dataclass, field

import numpy as np

from squeal.deck.journal import Fault

# Whether a file contains one triangle of a symmetric or skew-symmetric matrix, or all entries.
TRIANGLE, SKEW, WHOLE, UNKNOWN = "symmetric", "skew-symmetric", "whole", "unknown"
SAME = 1e-10  # of the largest entry: a difference of two triangles that round-off can explain


@dataclass
class Matrix:
    """The entries of a file. Rows and columns are numbers from 0 if `size` is given, otherwise keys
    of nodes and components (labels.py)."""

    format: str
    rows: np.ndarray
    columns: np.ndarray
    values: np.ndarray
    size: int = None
    form: str = UNKNOWN
    name: str = ""  # in a file of several matrices
    remarks: list = field(default_factory=list)


@dataclass
class Sparse:
    """Entries sorted by rows and columns, each place once, without zeros."""

    size: int
    rows: np.ndarray
    columns: np.ndarray
    values: np.ndarray
    form: str = ""  # what was taken from the file, in words
    read: int = 0  # entries of the file
    zeros: int = 0  # entries of the file that are zero
    duplicates: int = 0  # entries added to an earlier one of the same place

    def symmetric(self):
        """Returns whether the matrix equals its transpose bit for bit."""
        mirrored = np.lexsort((self.rows, self.columns))
        return bool(
            np.array_equal(self.columns[mirrored], self.rows)
            and np.array_equal(self.rows[mirrored], self.columns)
            and np.array_equal(self.values[mirrored], self.values)
        )

    def diagonal(self):
        found = np.zeros(self.size)
        on = self.rows == self.columns
        found[self.rows[on]] = self.values[on]
        return found

    def touched(self):
        """Returns for each row whether the row or the column of its number has an entry."""
        found = np.zeros(self.size, bool)
        found[self.rows] = True
        found[self.columns] = True
        return found

    def restricted(self, kept):
        """Returns the matrix of the rows and columns that are kept."""
        place = np.cumsum(kept) - 1
        chosen = kept[self.rows] & kept[self.columns]
        rows, columns = place[self.rows[chosen]], place[self.columns[chosen]]
        size, values = int(np.sum(kept)), self.values[chosen]
        counts = (self.form, self.read, self.zeros, self.duplicates)
        return Sparse(size, rows, columns, values, *counts)


def assemble(matrix, size, whole_if_unknown):
    """Assembles a matrix with rows from 0 to size - 1. `whole_if_unknown`: entries on one side of
    the diagonal are all entries, not a triangle. Raises Fault."""
    keys = matrix.rows * size + matrix.columns
    values = matrix.values
    if not np.all(np.isfinite(values)):
        raise Fault("an entry is not a finite number")
    read, nonzero = len(values), values != 0
    zeros = read - int(np.sum(nonzero))
    if zeros:  # such as those of dense columns, whose counterparts a triangle does not have
        keys, values = keys[nonzero], values[nonzero]
    keys, values = _sorted(keys, values)
    keys, values = _summed(keys, values)
    duplicates = read - zeros - len(keys)
    keys, values, form = _expanded(keys, values, size, matrix.form, whole_if_unknown)
    nonzero = values != 0  # sums can be zero
    if not np.all(nonzero):
        keys, values = keys[nonzero], values[nonzero]
    if not np.all(np.isfinite(values)):
        raise Fault("a sum of entries of the same place is not a finite number")
    rows = keys // size
    return Sparse(size, rows, keys - rows * size, values, form, read, zeros, duplicates)


def _sorted(keys, values):
    if np.all(keys[1:] >= keys[:-1]):
        return keys, values
    order = np.argsort(keys, kind="stable")  # sums of duplicates in the order of the file
    return keys[order], values[order]


def _summed(keys, values):
    first = np.flatnonzero(np.concatenate([[True], keys[1:] != keys[:-1]])[: len(keys)])
    if len(first) == len(keys):
        return keys, values
    with np.errstate(over="ignore", invalid="ignore"):  # assemble() finds what is not finite
        return keys[first], np.add.reduceat(values, first)


def _expanded(keys, values, size, form, whole_if_unknown):
    """Returns keys and values of all entries, and the form in words. Raises Fault."""
    rows = keys // size
    columns = keys - rows * size
    off = rows != columns
    if form == SKEW and np.any(values[~off]):
        raise Fault("a skew-symmetric matrix has entries on its diagonal")
    if form == WHOLE or not np.any(off):
        return keys, values, "all entries"
    mirrored = (columns * size + rows)[off]
    place = np.minimum(np.searchsorted(keys, mirrored), len(keys) - 1)
    both = keys[place] == mirrored
    if np.all(both):
        return keys, values, _words_of_both(values[off], values[place], form)
    if np.any(both) and form == UNKNOWN and whole_if_unknown:
        return keys, values, "all entries"
    if np.any(both):
        raise Fault(
            f"{int(np.sum(both))} of {int(np.sum(off))} entries off the diagonal are in both"
            " triangles, the others in one: neither a triangle nor a whole symmetric matrix"
            + (" (--whole: the file contains all entries)" if form == UNKNOWN else "")
        )
    if form == UNKNOWN and whole_if_unknown:
        if not np.all(off):
            raise Fault(
                "entries on the diagonal and in one triangle: all entries of a friction, or half of"
                " a symmetric matrix? (--whole or --triangle)"
            )
        return keys, values, "all entries, although only one of (i, j) and (j, i) is given"
    sign = -1 if form == SKEW else 1
    keys, values = _sorted(
        np.concatenate([keys, mirrored]), np.concatenate([values, sign * values[off]])
    )
    words = "one triangle, expanded"
    return keys, values, words if form != SKEW else f"{words} with the opposite sign"


def _words_of_both(values, mirrored, form):
    if form == UNKNOWN:
        return "all entries"
    sign = -1 if form == SKEW else 1
    difference = np.max(np.abs(values - sign * mirrored))
    if difference > SAME * np.max(np.abs(values)):
        raise Fault(f"declared {form}, but the entries of its two triangles differ")
    words = f"all entries; declared {form}"
    return words + (f", triangles differ by up to {difference:.1e}" if difference else "")
