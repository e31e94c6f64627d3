# SPDX-License-Identifier: BSD-2-Clause
"""Writes dense matrices entry by entry in the formats of other programs, and reads the matrices of
a case. Independent of the package; slow, for small matrices."""
import struct
from pathlib import Path

import numpy as np


def chain(count, mass=2.0, stiffness=48.0):
    """Returns stiffness and mass of equal masses in a row between two walls, joined by springs, and
    their exact circular frequencies."""
    identity = np.eye(count)
    beside = np.eye(count, k=1) + np.eye(count, k=-1)
    number = np.arange(1, count + 1)
    exact = 2 * np.sqrt(stiffness / mass) * np.sin(number * np.pi / (2 * (count + 1)))
    return stiffness * (2 * identity - beside), mass * identity, exact


def entries(matrix, part="all"):
    """Yields the places of entries that are not zero: all, those of the lower or upper triangle."""
    for i, j in zip(*np.nonzero(matrix)):
        if part == "all" or (i >= j if part == "lower" else i <= j):
            yield int(i), int(j)


def names(count, step=3):
    """Returns node and component of some rows: nodes 10, 20, … with components 1 to `step`."""
    return [(10 * (at // step + 1), at % step + 1) for at in range(count)]


def abaqus(matrix, part="lower", rows=None, header=""):
    rows = rows or names(len(matrix))
    lines = [header] if header else []
    for i, j in entries(matrix, part):
        lines.append(f"{rows[i][0]},{rows[i][1]}, {rows[j][0]},{rows[j][1]}, {matrix[i, j]:.16e}")
    return "\n".join(lines) + "\n"


def coordinates(matrix, part="lower", comma=", "):
    lines = [f"{i + 1}{comma}{j + 1}{comma}{matrix[i, j]:.16e}" for i, j in entries(matrix, part)]
    return "\n".join(lines) + "\n"


def calculix(matrix):
    """The upper triangle by columns, in the 14 digits of CalculiX."""
    lines = []
    for j in range(len(matrix)):
        for i in range(j + 1):
            if matrix[i, j] or i == j:
                lines.append(f"{i + 1} {j + 1} {matrix[i, j]:20.13e}")
    return "\n".join(lines) + "\n"


def dof(rows):
    return "".join(f"{node}.{component}\n" for node, component in rows)


def mapping(rows):
    labels = ("UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ")
    lines = ["   Matrix Eqn     Node    DOF"]
    for at, (node, component) in enumerate(rows, 1):
        lines.append(f"{at:12d}{node:12d}    {labels[component - 1]}")
    return "\n".join(lines) + "\n"


def matrix_market(matrix, form="symmetric"):
    places = list(entries(matrix, "all" if form == "general" else "lower"))
    if form == "skew-symmetric":
        places = [(i, j) for i, j in places if i > j]
    lines = [f"%%MatrixMarket matrix coordinate real {form}", "% a comment"]
    lines.append(f"{len(matrix)} {len(matrix)} {len(places)}")
    lines += [f"{i + 1} {j + 1} {matrix[i, j]:.16e}" for i, j in places]
    return "\n".join(lines) + "\n"


def _cards(numbers, per_line, form):
    texts = [form % number for number in numbers]
    return ["".join(texts[at : at + per_line]) for at in range(0, len(texts), per_line)]


def harwell_boeing(matrix, kind="RSA", sides=0, per_line=1):
    """`sides`: right-hand sides; `per_line`: numbers on a line, 1 as Ansys does."""
    size = len(matrix)
    pointers, indices, values = [1], [], []
    for j in range(size):
        for i in range(size):
            if matrix[i, j] and (kind == "RUA" or i >= j + (kind == "RZA")):
                indices.append(i + 1)
                values.append(matrix[i, j])
        pointers.append(len(indices) + 1)
    real = [("%24.16E" % one).replace("E", "D") for one in values]
    parts = [_cards(pointers, per_line, "%14d"), _cards(indices, per_line, "%14d")]
    parts.append(_cards(real, per_line, "%24s"))
    right = [line for _ in range(sides) for line in _cards([0.5] * size, per_line, "%24.16E")]
    counts = [len(part) for part in parts] + [len(right)]
    lines = [f"{'a matrix':72}{'key':8}", "".join(f"{one:14d}" for one in [sum(counts), *counts])]
    lines.append(f"{kind:14}{size:14d}{size:14d}{len(indices):14d}{0:14d}")
    integer, number = f"({per_line}I14)", f"({per_line}D24.16)"
    lines.append(f"{integer:16}{integer:16}{number:20}{number if sides else '':20}")
    if sides:
        lines.append(f"{'F':14}{sides:14d}{0:14d}")
    return "\n".join([*lines, *parts[0], *parts[1], *parts[2], *right]) + "\n"


def _runs(column, dense):
    """Returns runs of entries of a column: first row from 0, and values."""
    filled = np.flatnonzero(column)
    if len(filled) == 0:
        return []
    if dense:
        return [(int(filled[0]), column[filled[0] : filled[-1] + 1])]
    cuts = np.flatnonzero(np.diff(filled) > 1) + 1
    return [(int(part[0]), column[part]) for part in np.split(filled, cuts)]


def op4_text(matrices, layout="dense", form=6, words=1):
    """`matrices`: by name; layout: dense, sparse or bigmat; `words` of a value in dense columns."""
    lines = []
    for name, matrix in matrices.items():
        size = len(matrix)
        rows = -size if layout == "bigmat" else size
        lines.append(f"{size:8d}{rows:8d}{form:8d}{2:8d}{name:8}1P,3E24.16")
        for j in range(size):
            runs = _runs(matrix[:, j], layout == "dense")
            extra = {"dense": 0, "sparse": 1, "bigmat": 2}[layout]
            each = words if layout == "dense" else 2
            total = sum(each * len(run) + extra for _, run in runs)
            if not runs:
                continue
            lines.append(f"{j + 1:8d}{runs[0][0] + 1 if layout == 'dense' else 0:8d}{total:8d}")
            for first, run in runs:
                if layout == "sparse":
                    lines.append(f"{first + 1 + 65536 * (2 * len(run) + 1):12d}")
                elif layout == "bigmat":
                    lines.append(f"{2 * len(run) + 1:8d}{first + 1:8d}")
                lines += _cards(list(run), 3, "%24.16E")
        lines += [f"{size + 1:8d}{1:8d}{1:8d}", "  1.4142135623730951E+00"]
    return "\n".join(lines) + "\n"


def op4_binary(matrices, layout="dense", order="<", word=4, kind=2, form=6):
    """`kind`: 1 for single precision, 2 for double."""
    integer, real = "i" if word == 4 else "q", "f" if kind == 1 and word == 4 else "d"
    per_value = 2 if real == "d" and word == 4 else 1
    data = b""

    def record(content):
        length = struct.pack(order + "i", len(content))
        return length + content + length

    def pack(*numbers):
        return struct.pack(f"{order}{len(numbers)}{integer}", *numbers)

    for name, matrix in matrices.items():
        size = len(matrix)
        rows = -size if layout == "bigmat" else size
        data += record(pack(size, rows, form, kind) + name.ljust(2 * word).encode())
        for j in range(size):
            content, runs = b"", _runs(matrix[:, j], layout == "dense")
            for first, run in runs:
                length = per_value * len(run)
                if layout == "sparse":
                    content += pack(first + 1 + 65536 * (length + 1))
                elif layout == "bigmat":
                    content += pack(length + 1, first + 1)
                content += struct.pack(f"{order}{len(run)}{real}", *run)
            if runs:
                first = runs[0][0] + 1 if layout == "dense" else 0
                data += record(pack(j + 1, first, len(content) // word) + content)
        data += record(pack(size + 1, 1, 1) + struct.pack(order + "d", 2**0.5))
    return data


def dmig(matrices, field="large", form=6, rows=None):
    """`field`: large, small or free. Values are written with 9 digits, or as few in small field."""
    lines = ["$ punched"]
    for name, matrix in matrices.items():
        where = rows or names(len(matrix))
        lines += _dmig_header(name, form, field)
        for j in range(len(matrix)):
            part = "lower" if form == 6 else "all"
            found = [i for i, at in entries(matrix, part) if at == j]
            quads = [(*where[i], float(matrix[i, j])) for i in found]
            if quads:
                lines += _dmig_column(name, where[j], quads, field)
    return "\n".join(lines) + "\n"


def _dmig_header(name, form, field):
    if field == "free":
        return [f"DMIG,{name},0,{form},2,0"]
    return [f"DMIG    {name:8}{0:8d}{form:8d}{2:8d}{0:8d}"]


def _dmig_column(name, column, quads, field):
    node, component = column
    if field == "large":
        lines = [f"DMIG*   {name:16}{node:16d}{component:16d}"]
        return lines + [f"*       {i:16d}{c:16d}{v:16.9E}" for i, c, v in quads]
    texts = [(str(i), str(c), _short(v), "") for i, c, v in quads]
    head = ["DMIG", name, str(node), str(component), "", *texts[0]]
    rest = [sum(texts[at : at + 2], ()) for at in range(1, len(texts), 2)]
    if field == "free":
        return [",".join(head)] + ["," + ",".join(one) for one in rest]
    lines = ["".join(f"{one:8}" for one in head)]
    return lines + ["+       " + "".join(f"{one:8}" for one in one) for one in rest]


def _short(value):
    """Returns a number of at most 8 columns with a point and an exponent without letter."""
    text = f"{value:.2E}".replace("E", "")
    mantissa, exponent = text[:-3], int(text[-3:])
    return f"{mantissa}{exponent:+d}"


def petsc(path):
    """Returns the dense matrix of a PETSc binary file, and its number of entries."""
    data = Path(path).read_bytes()
    mark, rows, columns, count = struct.unpack_from(">4i", data)
    assert (mark, rows) == (1211216, columns)
    assert len(data) == 16 + 4 * rows + 12 * count
    lengths = struct.unpack_from(f">{rows}i", data, 16)
    places = struct.unpack_from(f">{count}i", data, 16 + 4 * rows)
    values = struct.unpack_from(f">{count}d", data, 16 + 4 * rows + 4 * count)
    matrix, at = np.zeros((rows, rows)), 0
    for row, length in enumerate(lengths):
        mine = places[at : at + length]
        assert list(mine) == sorted(set(mine))
        matrix[row, list(mine)] = values[at : at + length]
        at += length
    assert at == count
    return matrix, count
