# SPDX-License-Identifier: BSD-2-Clause
"""Matrices of CalculiX: *FREQUENCY, SOLVER=MATRIXSTORAGE writes JOB.sti, JOB.mas and JOB.dof.

.sti and .mas contain the upper triangle by columns, one line an entry: row, column, value with 14
digits. The diagonal is complete, so that the last entry is that of the last row and column. .dof
contains for each row node.direction. The second triangle of an unsymmetric stiffness is not stored.
Source: CalculiX 2.20, matrixstorage.c and arpack.c, and its files.
"""
import re
from pathlib import Path

import numpy as np

from squeal.deck.journal import Fault
from squeal.matrices.coordinate import TRIANGLE, Matrix
from squeal.matrices.labels import LARGEST_NODE, keys_of, require_components
from squeal.matrices.text import Lines, read_bytes, require_integers, tables

NAME = "CalculiX"
SUFFIXES = {".sti": "stiffness", ".mas": "mass"}


def _refuse_mark(line, text):
    raise Fault(f"'{text[:40]}' is not an entry", line=line)


def read(path):
    """Returns the matrix of a .sti or .mas file. Raises Fault."""
    parts, last = [], 0
    for table, lines in tables(path, (3,), b"*", _refuse_mark):
        numbers = require_integers(table, [0, 1], lines)
        wrong = (numbers < 1) | (numbers >= 2**31)
        wrong[:, 0] |= numbers[:, 0] > numbers[:, 1]
        if np.any(wrong):
            at = int(np.argmax(np.any(wrong, axis=1)))
            raise Fault("not an entry of the upper triangle", line=int(lines[at]))
        parts.append((numbers[:, 0] - 1, numbers[:, 1] - 1, table[:, 2].copy()))
        last = int(lines[-1])
    if not parts:
        raise Fault("the file has no entry")
    rows, columns, values = (np.concatenate(part) for part in zip(*parts))
    size = int(columns.max()) + 1
    found = np.zeros(size, bool) if size <= len(rows) else np.zeros(1, bool)
    if size <= len(rows):
        found[rows[rows == columns]] = True
    if not np.all(found) or rows[-1] != size - 1:
        raise Fault(
            "the diagonal is not complete, or its last entry not the last of the file: cut short"
            " or damaged",
            line=last,
        )
    found = Matrix(NAME, rows, columns, values, size, TRIANGLE)
    if Path(path).suffix.lower() == ".sti":
        found.remarks.append("CalculiX stores one triangle: friction of contacts is not in it")
    return found


def read_dof(path):
    """Returns the keys of the rows by a .dof file. Raises Fault."""
    data = read_bytes(path)
    text = Lines(data)
    whole = re.compile(rb"[ \t]*(\d{1,15})\.(\d{1,2})[ \t\r]*")
    found = []
    for line, one in enumerate(data[:-1].split(b"\n"), 1):
        match = whole.fullmatch(one)
        if not match:
            shown = one[:40].decode("latin-1")
            raise Fault(f"'{shown}' is not node.direction", line=line)
        found.append((int(match[1]), int(match[2])))
    nodes, components = np.array(found, np.int64).reshape(-1, 2).T
    if np.any(nodes >= LARGEST_NODE) or len(text) != len(nodes):
        raise Fault("the number of a node is too large")
    require_components(components, lambda at: at + 1)
    return keys_of(nodes, components)
