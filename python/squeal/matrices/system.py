# SPDX-License-Identifier: BSD-2-Clause
"""Brings matrices to common rows, checks them against each other, and removes rows that no equation
belongs to."""
from dataclasses import dataclass, field

import numpy as np

from squeal.deck.journal import DeckError, Fault
from squeal.matrices import abaqus
from squeal.matrices.coordinate import TRIANGLE, WHOLE, assemble
from squeal.matrices.labels import Rows, words_of_key

STIFFNESS, MASS = "stiffness", "mass"
MANY = 10**7  # rows
# Role for the user → power of s, and exponents of options, for the program.
ROLES = {
    STIFFNESS: ("stiffness", {}),
    MASS: ("mass", {}),
    "damping": ("damping", {}),
    "friction": ("stiffness", {"friction_exponent": 1}),
    "friction-damping": ("damping", {"friction_exponent": 1}),
    "gyroscopic": ("damping", {"speed_exponent": 1}),
}


class Record:
    """Choices made on the way, and all faults."""

    def __init__(self):
        self.choices, self.faults = [], []

    def choose(self, text):
        if text not in self.choices:
            self.choices.append(text)

    def refuse(self, text):
        if text not in self.faults:
            self.faults.append(text)

    def require(self, title):
        """Raises DeckError with all faults."""
        if self.faults:
            lines = "\n".join(f"  {one}" for one in self.faults)
            raise DeckError(f"{title} cannot be imported:\n{lines}")


@dataclass
class Part:
    """A matrix of the case: its role, its name there, its file, its entries."""

    role: str
    name: str
    source: object
    matrix: object = None
    sparse: object = None


@dataclass
class System:
    parts: list
    rows: Rows = None
    omitted: list = field(default_factory=list)  # Rows that were removed, and the reason

    @property
    def base(self):
        """The matrices that define the rows."""
        return [part for part in self.parts if part.role == STIFFNESS]


@dataclass
class Names:
    """Keys of the rows of matrices that have only numbers, and the file that they are from."""

    keys: np.ndarray
    file: str


def build(parts, names, forms, record):
    """Assembles the matrices of a case. `names`: Names or None; `forms`: by role or by name in the
    case, whether files contain all entries (WHOLE) or a TRIANGLE, where they do not declare it.
    Raises DeckError with all faults."""
    system = System(parts)
    title = str(parts[0].source)
    _number(system, names, record)
    record.require(title)
    for part in parts:
        form = forms.get(part.name, forms.get(part.role))
        if form and part.matrix.form == (TRIANGLE if form == WHOLE else WHOLE):
            record.refuse(f"{part.source}: declared {part.matrix.form}, not {form}")
            continue
        if form:
            part.matrix.form = form
        try:
            whole = part.role.startswith("friction")
            part.sparse = assemble(part.matrix, system.rows.size, whole)
        except Fault as fault:
            reason = fault.reason
            for word in ("--whole", "--triangle"):
                reason = reason.replace(word, f"{word} {part.name}")
            record.refuse(f"{part.source}: {reason}")
        part.matrix.rows = part.matrix.columns = part.matrix.values = None
    record.require(title)
    _remove_held(system, record)
    _remove_empty(system, record)
    _report_zeros(system, record)
    if system.rows.size == 0:
        record.refuse("no row is left")
    record.require(title)
    return system


def _number(system, names, record):
    """Replaces the rows and columns of all matrices by numbers from 0."""
    numbered = [part for part in system.parts if part.matrix.size is not None]
    for part in numbered[1:]:
        if part.matrix.size != numbered[0].matrix.size:
            record.refuse(
                f"{part.source}: {part.matrix.size} rows, but {numbered[0].source} has"
                f" {numbered[0].matrix.size}"
            )
    for part in numbered:
        size, count = part.matrix.size, len(part.matrix.values)
        if size > MANY and count < size // 10:  # before memory is taken for the rows
            record.refuse(f"{part.source}: {size} rows, but only {count} entries")
    named = [part for part in system.parts if part.matrix.size is None]
    if names is None and numbered:
        for part in named:
            record.refuse(
                f"{part.source}: rows are nodes and components, but those of"
                f" {numbered[0].source} numbers: give the nodes by --rows"
            )
    elif numbered and not record.faults:
        _check_names(numbered[0], names, record)
    if record.faults:
        return
    if numbered:
        keys = names and names.keys
        system.rows = Rows(numbered[0].matrix.size, keys)
    else:
        found = [np.unique(np.concatenate(_keys(part))) for part in system.base]
        keys = np.unique(np.concatenate(found))
        system.rows = Rows(len(keys), keys)
    for part in named:
        _match(part, keys, record)


def _check_names(part, names, record):
    """Requires a name for each row of a matrix with numbers of rows, each once."""
    size, keys = part.matrix.size, names.keys
    if len(keys) != size:
        hint = ""
        if 2 * len(keys) == size:
            hint = "; twice as many rows are the real and imaginary parts of cyclic symmetry"
        record.refuse(
            f"{part.source}: {size} rows, but {names.file} has names for {len(keys)}{hint}"
        )
    elif len(np.unique(keys)) < len(keys):
        unique, counts = np.unique(keys, return_counts=True)
        record.refuse(f"{names.file}: {words_of_key(unique[counts > 1][0])} occurs twice")


def _match(part, keys, record):
    """Replaces keys of rows by their places in a list of keys."""
    order = np.argsort(keys)
    ordered, ends = keys[order], []
    for ours in _keys(part):
        place = np.minimum(np.searchsorted(ordered, ours), len(keys) - 1)
        strange = np.unique(ours[ordered[place] != ours])
        if len(strange):
            words = "; ".join(words_of_key(one) for one in strange[:5])
            record.refuse(
                f"{part.source}: {len(strange)} rows or columns that the stiffness does not"
                f" have: {words}{'; …' if len(strange) > 5 else ''}"
            )
            return
        ends.append(order[place])
    part.matrix.rows, part.matrix.columns = ends


def _keys(part):
    return part.matrix.rows, part.matrix.columns


def _remove_held(system, record):
    """Removes rows that Abaqus holds by a diagonal of 1e36."""
    held = np.zeros(system.rows.size, bool)
    for part in system.base:
        if part.matrix.format.startswith(abaqus.NAME):
            held |= part.sparse.diagonal() == abaqus.HELD
    if np.any(held):
        record.choose(
            f"{int(np.sum(held))} rows with the diagonal 1e36 are held by Abaqus: removed with"
            f" their columns ({system.rows.words(held)})"
        )
        _remove(system, held, "held")


def _remove_empty(system, record):
    """Removes rows without an entry in any matrix."""
    empty = ~np.any([part.sparse.touched() for part in system.parts], axis=0)
    if np.any(empty):
        record.choose(
            f"{int(np.sum(empty))} rows and columns have no entry but zeros in any matrix: removed"
            f" ({system.rows.words(empty)})"
        )
        _remove(system, empty, "empty")


def _remove(system, gone, reason):
    for part in system.parts:
        part.sparse = part.sparse.restricted(~gone)
    system.omitted.append((system.rows.restricted(gone), reason))
    system.rows = system.rows.restricted(~gone)


def _report_zeros(system, record):
    """Reports rows without stiffness, which the program refuses, and rows without mass."""
    zero = ~np.any([part.sparse.touched() for part in system.base], axis=0)
    if np.any(zero):
        record.choose(
            f"{int(np.sum(zero))} rows have no stiffness, which the program refuses:"
            f" {system.rows.words(zero)}"
        )
    masses = [part.sparse.touched() for part in system.parts if part.role == MASS]
    massless = ~np.any(masses, axis=0) if masses else np.zeros(system.rows.size, bool)
    if np.any(massless):
        record.choose(
            f"{int(np.sum(massless))} rows have no mass: they follow the others"
            f" ({system.rows.words(massless)})"
        )
