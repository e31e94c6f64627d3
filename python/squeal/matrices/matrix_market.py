# SPDX-License-Identifier: BSD-2-Clause
"""Matrix Market files of coordinates (https://math.nist.gov/MatrixMarket/formats.html)."""
import numpy as np

from squeal.deck.journal import Fault
from squeal.matrices.coordinate import SKEW, TRIANGLE, WHOLE, Matrix
from squeal.matrices.text import require_integers, tables

NAME = "Matrix Market"
MARK = b"%%MatrixMarket"
FORMS = {"general": WHOLE, "symmetric": TRIANGLE, "skew-symmetric": SKEW}


def read(path):
    """Returns the matrix of a file. Raises Fault."""
    comments = []

    def on_mark(line, text):
        comments.append((line, text))

    parts, size, wanted, last = [], None, 0, 1
    for table, lines in tables(path, (3,), b"%", on_mark):
        numbers = require_integers(table, [0, 1], lines)
        if size is None:
            form = _form(comments)
            if numbers[0, 0] != numbers[0, 1]:
                raise Fault(f"{numbers[0, 0]} rows and {numbers[0, 1]} columns", line=int(lines[0]))
            size, wanted = int(numbers[0, 0]), table[0, 2]
            table, numbers, lines = table[1:], numbers[1:], lines[1:]
        wrong = (numbers < 1) | (numbers > size)
        if np.any(wrong):
            at = int(np.argmax(np.any(wrong, axis=1)))
            raise Fault("a row or column is not in the matrix", line=int(lines[at]))
        parts.append((numbers[:, 0] - 1, numbers[:, 1] - 1, table[:, 2].copy()))
        last = int(lines[-1]) if len(lines) else last
    if not parts:
        raise Fault("the file has no line of sizes")
    rows, columns, values = (np.concatenate(part) for part in zip(*parts))
    if len(rows) != wanted:
        raise Fault(f"{len(rows)} entries, but the line of sizes says {wanted:g}", line=last)
    if form != WHOLE and np.any(rows < columns) and np.any(rows > columns):
        raise Fault("entries on both sides of the diagonal of a matrix that is declared symmetric")
    found = Matrix(NAME, rows, columns, values, size, form)
    if len(comments) > 1:
        found.remarks.append(f"{len(comments) - 1} lines of comments are not used")
    return found


def _form(comments):
    words = comments[0][1].lower().split() if comments else []
    if not words or comments[0][0] != 1 or words[:2] != ["%%matrixmarket", "matrix"]:
        raise Fault("the first line is not '%%MatrixMarket matrix …'", line=1)
    if words[2:3] != ["coordinate"]:
        raise Fault("arrays are not supported, only coordinates", line=1)
    if words[3:4] not in (["real"], ["integer"], ["double"]):
        raise Fault(f"entries of the type {' '.join(words[3:4])} are not supported", line=1)
    if len(words) != 5 or words[4] not in FORMS:
        raise Fault(f"the symmetry {' '.join(words[4:])} is not supported", line=1)
    return FORMS[words[4]]
