# SPDX-License-Identifier: BSD-2-Clause
"""Imports matrices of other programs into the folder of a case."""
from pathlib import Path

import numpy as np

from squeal.deck.journal import DeckError, Fault
from squeal.deck.output.folder import prepare
from squeal.matrices import output, sources
from squeal.matrices.coordinate import TRIANGLE, WHOLE
from squeal.matrices.system import MASS, ROLES, STIFFNESS, Names, Part, Record, build


def import_matrices(files, folder, rows=None, forms=None):
    """Writes the case of matrices into a folder, and returns its record. If the matrices are
    refused, writes only import.md and raises DeckError. `files`: pairs of a role of ROLES and a
    file; `rows`: file with the names of the rows; `forms`: WHOLE or TRIANGLE by role or name."""
    folder, record = Path(folder), Record()
    parts = _parts(files)
    title = ", ".join(str(part.source) for part in parts)
    system = None
    try:
        _read(parts, record)
        names = _names(rows, parts, record)
        record.require(str(parts[0].source))
        record.choose("the units are those of the files, which do not state them")
        try:
            system = build(parts, names, forms or {}, record)
        except MemoryError:
            raise DeckError(f"{title}: not enough memory") from None
        output.require_size(system, record)
        record.require(str(parts[0].source))
        _choose(system, record)
    except DeckError:
        prepare(folder)
        try:
            output.write_account(folder / "import.md", None, record, title)
        except OSError as error:
            raise DeckError(f"{error.filename or folder}: {error.strerror}") from None
        raise
    prepare(folder)
    output.write_case(folder, system, record, title)
    return record


def _parts(files):
    """Returns the matrices with their names in the case. Raises DeckError."""
    counts, parts = {}, []
    for role in ROLES:
        for one, word in files:
            if one == role:
                counts[role] = counts.get(role, 0) + 1
                name = role.replace("-", "_") + (f"_{counts[role]}" if counts[role] > 1 else "")
                parts.append(Part(role, name, sources.Source(word)))
    for role in (STIFFNESS, MASS):
        if role not in counts:
            raise DeckError(f"a case of matrices needs a {role} matrix: --{role} FILE")
    return parts


def _read(parts, record):
    for part in parts:
        try:
            part.matrix = part.source.read()
        except Fault as fault:
            name = sources.shown(part.source.path)
            place = f"{name}:{fault.line}" if fault.line else str(part.source)
            record.refuse(f"{place}: {fault.reason}")
        except MemoryError:
            record.refuse(f"{part.source}: not enough memory")
        else:
            for remark in part.matrix.remarks:
                record.choose(f"{part.source}: {remark}")


def _names(rows, parts, record):
    """Returns the names of the rows of matrices without them, or None."""
    numbered = [part for part in parts if part.matrix and part.matrix.size is not None]
    found = [Path(rows)] if rows else []
    if not found:
        found = sources.rows_next_to([part.source.path for part in numbered])
    names = None
    for path in found:
        try:
            one = sources.read_rows(path)
        except Fault as fault:
            place = sources.shown(path) + (f":{fault.line}" if fault.line else "")
            record.refuse(f"{place}: {fault.reason}")
            continue
        if names and not np.array_equal(one, names.keys):
            record.refuse(f"{sources.shown(path)}: other rows than in {names.file}")
        names = Names(one, sources.shown(path))
        record.choose(f"{names.file}: names of the rows")
    if rows and not numbered and not record.faults:
        record.refuse(f"{rows}: all matrices have names of their rows")
    if numbered and not found:
        record.choose("no file of the rows: nodes and components are not known, --rows gives them")
    return names


def _choose(system, record):
    """Notes the choices of the options."""
    if output.friction_of(system) != "0.0":
        record.choose("friction is swept from 0 to 1; edit case.yaml for other values")
    for part in system.parts:
        record.choose(f"{part.source}: {part.name}, {part.sparse.form}")
        if part.sparse.duplicates:
            record.choose(
                f"{part.source}: {part.sparse.duplicates} entries of the same place are summed"
            )


def add_options(parser):
    """Adds the options of matrices to those of squeal-import."""
    group = parser.add_argument_group("matrices in place of a deck")
    for role, (power, exponents) in ROLES.items():
        factor = {"stiffness": "1", "damping": "s", "mass": "s^2"}[power]
        factor += "".join(f" and by {one.rpartition('_')[0]}" for one in exponents)
        text = f"matrix that is multiplied by {factor}; PATH:NAME for one of several in a file"
        group.add_argument(f"--{role}", metavar="FILE", action="append", default=[], help=text)
    text = "names of the rows: .dof of CalculiX, mapping file of Ansys, or row,node,component"
    group.add_argument("--rows", metavar="FILE", help=text)
    for form, words in (("whole", "all entries"), ("triangle", "one triangle")):
        text = f"role or name of a matrix, such as {STIFFNESS}, whose file contains {words}"
        group.add_argument(f"--{form}", metavar="ROLE", action="append", default=[], help=text)


def files_of(given):
    """Returns roles and files by the words of the command line, empty for a deck."""
    files = [(role, word) for role in ROLES for word in getattr(given, role.replace("-", "_"))]
    job = sources.job_of(given.deck) if given.deck else None
    return (job or []) + files


def run(given, files, parser):
    """Imports the matrices of the command line, and prints the choices."""
    if given.deck and not sources.job_of(given.deck):
        parser.error("a deck and matrices at once")
    for name in ("ignore", "dialect", "speed", "subcase"):
        if getattr(given, name):
            parser.error(f"--{name} is for decks")
    forms = {role: WHOLE for role in given.whole}
    forms |= {role: TRIANGLE for role in given.triangle}
    parts = _parts(files)
    known = {part.role for part in parts} | {part.name for part in parts}
    for name in [*given.whole, *given.triangle]:
        if name not in known or (name in given.whole and name in given.triangle):
            parser.error(f"--whole and --triangle take the role of a matrix, not '{name}'")
    stem = next((sources.Source(word).path.stem for role, word in files if role == STIFFNESS), "")
    folder = Path(given.output or (f"{stem}_case" if Path(stem).is_file() else stem))
    record = import_matrices(files, folder, given.rows, forms)
    print(f"{folder / 'case.yaml'}: the case; {folder / 'import.md'}: the account of the matrices")
    for choice in record.choices:
        print(f"  {choice}")
