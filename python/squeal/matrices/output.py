# SPDX-License-Identifier: BSD-2-Clause
"""Writes the case of matrices: a PETSc binary file for each, case.yaml, rows.csv, import.md."""
import os

import numpy as np

from squeal.deck.journal import DeckError
from squeal.deck.output.options import MARK
from squeal.matrices.labels import components_of, nodes_of
from squeal.matrices.system import ROLES

CLASS = 1211216  # of matrices in PETSc's binary format, see its manual page of MatLoad()
MOST = 2**31 - 1


def require_size(system, record):
    for part in system.parts:
        if max(part.sparse.size, len(part.sparse.values)) > MOST:
            record.refuse(f"{part.source}: more rows or entries than {MOST}")


def write_matrix(path, sparse):
    """Writes a matrix in PETSc's binary format. Raises OSError."""
    lengths = np.bincount(sparse.rows, minlength=sparse.size)
    partial = f"{path}.partial"
    try:
        with open(partial, "wb") as file:
            header = [CLASS, sparse.size, sparse.size, len(sparse.values)]
            np.array(header, ">i4").tofile(file)
            lengths.astype(">i4").tofile(file)
            sparse.columns.astype(">i4").tofile(file)
            sparse.values.astype(">f8").tofile(file)
        os.replace(partial, path)
    finally:
        if os.path.exists(partial):
            os.remove(partial)


def write_rows(path, rows):
    """Writes the table of the rows. Raises OSError."""
    with open(path, "w", encoding="utf-8") as file:
        file.write("row," + _titles(rows) + "\n")
        for at, words in enumerate(_names(rows), 1):
            file.write(f"{at},{words}\n")


def write_omitted(path, omitted):
    """Writes the table of the rows that were removed. Raises OSError."""
    with open(path, "w", encoding="utf-8") as file:
        file.write(_titles(omitted[0][0]) + ",reason\n")
        for rows, reason in omitted:
            for words in _names(rows):
                file.write(f"{words},{reason}\n")


def _titles(rows):
    return "row_of_file" if rows.keys is None else "node,component"


def _names(rows):
    if rows.keys is None:
        return (str(number) for number in rows.numbers.tolist())
    pairs = zip(nodes_of(rows.keys).tolist(), components_of(rows.keys).tolist())
    return (f"{node},{component}" for node, component in pairs)


def file_of(part):
    return f"{part.name}.petsc"


def write_options(path, system, title):
    """Writes case.yaml. Raises OSError."""
    lines = [f"{MARK} {title}. The units are those of the files.", ""]
    lines += ["# rows.csv: node and component of each row.", "", "matrices:"]
    for part in system.parts:
        power, exponents = ROLES[part.role]
        lines += [f"  {part.name}:", f"    file: {file_of(part)}  # {part.source}"]
        lines.append(f"    role: {power}")
        lines += [f"    {key}: {value}" for key, value in exponents.items()]
    lines += ["", "flutter:", f'  friction: "{friction_of(system)}"']
    if any("speed_exponent" in ROLES[part.role][1] for part in system.parts):
        lines.append("  speed: 1")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


def friction_of(system):
    """Returns the sweep of friction: a point if no matrix depends on it."""
    swept = any("friction_exponent" in ROLES[part.role][1] for part in system.parts)
    return "0:1:0.1" if swept else "0.0"


def write_account(path, system, record, title):
    """Writes import.md; `system`: None if the import is refused. Raises OSError."""
    lines = [f"# {title}", ""]
    if record.faults:
        lines += ["The matrices cannot be imported:", ""]
        lines += [*(f"- {one}" for one in record.faults), ""]
    lines += ["## Choices", "", *(f"- {one}" for one in record.choices), ""]
    if system is not None:
        lines += _matrices(system)
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


def _matrices(system):
    lines = [f"{system.rows.size} rows; rows.csv has their names."]
    if system.omitted:
        count = sum(rows.size for rows, _ in system.omitted)
        lines.append(f"{count} rows were removed; omitted_rows.csv has their names.")
    lines += [
        "",
        "## Matrices",
        "",
        "| name | file | format | taken as | entries read | of these zero | summed duplicates |"
        " entries written | sum | symmetric |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for part in system.parts:
        one = part.sparse
        cells = (part.name, _cell(part.source), part.matrix.format, one.form, one.read, one.zeros)
        cells += (one.duplicates, len(one.values), repr(float(np.sum(one.values))))
        cells += ("yes" if one.symmetric() else "no",)
        lines.append("| " + " | ".join(str(cell) for cell in cells) + " |")
    return [*lines, ""]


def _cell(source):
    return str(source).replace("|", "\\|")


def write_case(folder, system, record, title):
    """Writes all files of a case. Raises DeckError."""
    try:
        write_account(folder / "import.md", system, record, title)
        for part in system.parts:
            write_matrix(folder / file_of(part), part.sparse)
        write_rows(folder / "rows.csv", system.rows)
        if system.omitted:
            write_omitted(folder / "omitted_rows.csv", system.omitted)
        write_options(folder / "case.yaml", system, title)
    except OSError as error:
        raise DeckError(f"{error.filename or folder}: {error.strerror}") from None
