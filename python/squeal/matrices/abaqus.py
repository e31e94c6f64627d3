# SPDX-License-Identifier: BSD-2-Clause
"""Matrices of Abaqus' *MATRIX OUTPUT (.mtx), as text.

Each line contains node, degree of freedom, node, degree of freedom and value (FORMAT=MATRIX INPUT
or LABELS), or row, column and value (FORMAT=COORDINATE). Source: Abaqus Keywords Reference Guide,
*MATRIX INPUT and *MATRIX OUTPUT. Symmetric matrices are given by one triangle or as a square; in a
square of TYPE=SYMMETRIC, entries above and below the diagonal are equal. Nodes that Abaqus adds
have negative numbers. The diagonal of a constrained degree of freedom is 1e36, and its other
entries are still there; system.py removes such rows.
"""
import re

import numpy as np

from squeal.deck.journal import Fault
from squeal.matrices.coordinate import TRIANGLE, UNKNOWN, WHOLE, Matrix
from squeal.matrices.labels import LARGEST_NODE, keys_of, require_components
from squeal.matrices.text import require_integers, tables

NAME = "Abaqus"
HELD = 1e36


def read(path):
    """Returns the matrix of a file. Raises Fault."""
    header = _Header()
    parts = []
    for table, lines in tables(path, (5, 3), b"*", header.read):
        parts.append(_entries(table, lines))
    if not parts:
        raise Fault("the file has no entry")
    rows, columns, values = (np.concatenate(part) for part in zip(*(one[:3] for one in parts)))
    labelled = parts[0][3]
    size = None if labelled else int(max(rows.max(), columns.max())) + 1
    if not labelled and rows[0] == columns[0] == size - 1 and values[0] == len(rows) - 1:
        raise Fault(
            "the first line is one of sizes, as in Matrix Market: add the header of that format, or"
            " remove the line"
        )
    found = Matrix(NAME if labelled else f"{NAME}, COORDINATE", rows, columns, values, size)
    found.form = header.form
    found.remarks = header.remarks()
    return found


def _entries(table, lines):
    labelled = table.shape[1] == 5
    if labelled:
        numbers = require_integers(table, [0, 1, 2, 3], lines)
        wrong = (np.abs(numbers[:, [0, 2]]) >= LARGEST_NODE) | (numbers[:, [0, 2]] == 0)
        if np.any(wrong):
            at = int(np.argmax(np.any(wrong, axis=1)))
            raise Fault("a node has the number 0 or one that is too large", line=int(lines[at]))
        for column in (1, 3):
            require_components(numbers[:, column], lambda at: int(lines[at]))
        rows, columns = keys_of(*numbers[:, :2].T), keys_of(*numbers[:, 2:].T)
    else:
        numbers = require_integers(table, [0, 1], lines)
        wrong = (numbers < 1) | (numbers >= 2**31)
        if np.any(wrong):
            at = int(np.argmax(np.any(wrong, axis=1)))
            raise Fault("a row or column is less than 1 or too large", line=int(lines[at]))
        rows, columns = (numbers - 1).T
    return rows, columns, table[:, -1].copy(), labelled


class _Header:
    """Comments, and the keyword line of a deck that contains the matrix."""

    def __init__(self):
        self.form, self.comments, self.keywords = UNKNOWN, 0, 0

    def read(self, line, text):
        if text.startswith("**"):
            self.comments += 1
            return
        words = ["".join(word.upper().split()) for word in text.split(",")]
        if words[0] != "*MATRIXINPUT":
            hint = ""
            if words[0] in ("*MATRIX", "*USERELEMENT", "*CLOAD"):
                hint = "; the import needs the assembled matrix of *MATRIX OUTPUT"
            raise Fault(f"{text.split(',')[0]} is not supported{hint}", line=line)
        self.keywords += 1
        if self.keywords > 1:
            raise Fault("a second matrix; the import needs a file for each", line=line)
        for word in words[1:]:
            self._parameter(word, line)

    def _parameter(self, word, line):
        name, _, value = word.partition("=")
        if name == "TYPE" and value in ("SYMMETRIC", "UNSYMMETRIC"):
            self.form = TRIANGLE if value == "SYMMETRIC" else WHOLE
        elif not re.fullmatch("NAME|", name):
            raise Fault(f"*MATRIX INPUT, {word} is not supported", line=line)

    def remarks(self):
        return [f"{self.comments} lines of comments are not used"] if self.comments else []
