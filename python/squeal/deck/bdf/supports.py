# SPDX-License-Identifier: BSD-2-Clause
"""Supports: SPC, SPC1, SPCADD and SPCD, and equations: MPC and MPCADD, of the selected sets."""
import numpy as np

from squeal.deck.bdf.handlers import handles
from squeal.deck.bdf.unions import in_itself, opened
from squeal.deck.journal import TRANSLATED, UNUSED, USED, Fault
from squeal.deck.model import Equation, Value


def sets_of(reader, kind, union, simple):
    """Returns the numbers of the sets that a selection (spc or mpc) comprises: `union` is the card
    that joins sets, which has precedence over `simple` ones of its number; None if all of them
    count."""
    selected = getattr(reader.selection, kind)
    joined, sources = {}, {}
    for card in reader.deck.each(union):
        try:
            number = card.identifier(1)
            ranges = card.numbers(2)
            if any(first != last for first, last in ranges):
                raise Fault("THRU is not supported", line=card.line)
            card.unread()
            joined.setdefault(number, set()).update(first for first, _ in ranges)
            sources[number] = card.source
        except Fault as fault:
            reader.journal.refuse(card.source, fault.reason, fault.name, fault.line)
            continue
        taken = reader.selection.everything or number == selected
        remark = "" if taken else f"set {number} is not selected"
        reader.journal.mark(card.source, USED if taken else UNUSED, remark)
    if reader.selection.everything:
        return None
    if selected is None:
        return set()
    chosen, unions = opened(joined, selected)
    number = in_itself(joined, unions)
    if number is not None:
        reader.journal.refuse(sources[number], f"{union} {number} contains itself")
        return set()
    known = {number for name in simple for number in _numbers(reader, name)}
    if kind == "contact" and 0 in known:
        chosen.add(0)  # the table of number 0 always counts
    for number in sorted(chosen - known):
        source = reader.selection.sources[kind]
        reader.journal.refuse(source, f"there is no set {number} of {' or '.join(simple)}")
    return chosen


def _numbers(reader, name):
    for fields, _, _ in reader.deck.rows(name):
        if fields[0].isdigit():
            yield int(fields[0])


def selected(card, reader, chosen, number=None):
    """Returns the number of the set of a card, or None if it is not selected. `number`: that of the
    set, if it may be 0."""
    if number is None:
        number = card.identifier(1)
    if chosen is None or number in chosen:
        reader.journal.mark(card.source, TRANSLATED)
        return number
    reader.journal.mark(card.source, UNUSED, f"set {number} is not selected")
    card.read.update(range(1, len(card.fields) + 1))
    return None


def _hold(reader, card, label, numbers, components, value):
    """Adds supports; rotations of nodes of solid cells do not exist."""
    state, journal = reader.model.state, reader.journal
    there = reader.model.nodes.has(numbers)
    if not np.all(there):
        missing = numbers[~there]
        raise Fault(f"grid {missing[0]} does not exist", line=card.line)
    inside = reader.without_rotations(numbers)
    if np.any(inside) and max(components) > 2:
        if value:
            raise Fault("nodes of solid elements have no rotations", line=card.line)
        journal.remark(card.source, "rotations of nodes of solid elements do not exist")
    held = Value(value, label, card.source)
    for number, cell in zip(numbers.tolist(), inside.tolist()):
        for at in components:
            if at > 2 and cell:
                continue
            before = state.supports.get((number, at))
            if before is not None and before.value and value and before.value != value:
                raise Fault(f"component {at + 1} of grid {number} has two values", line=card.line)
            if before is None or value:
                state.supports[number, at] = held


def _label(reader, number, card, numbers):
    """Returns the key of the node set of a set of supports, which its nodes join."""
    label = f"SPC_{number}"
    reader.model.node_sets.add(label, label.lower(), card.source, [numbers])
    return label


@handles("SPC")
def spc(card, reader):
    number = selected(card, reader, reader.spc_sets)
    if number is None:
        return
    for first in (2, 5):
        if first == 2 or card.word(first):
            grids = np.array([card.identifier(first)], np.int64)
            components = card.components(first + 1)
            value = card.real(first + 2, 0.0)
            _hold(reader, card, _label(reader, number, card, grids), grids, components, value)


@handles("SPC1")
def spc1(card, reader):
    number = selected(card, reader, reader.spc_sets)
    if number is None:
        return
    components = card.components(2)
    ranges = card.numbers(3)
    if not ranges:
        raise Fault("no grid is named", line=card.line)
    grids = reader.grids_in(ranges, card)
    _hold(reader, card, _label(reader, number, card, grids), grids, components, 0.0)


@handles("SPCD", phase=3)
def spcd(card, reader):
    """Values of supports, which belong to a load."""
    if selected(card, reader, reader.spcd_sets) is None:
        return
    for first in (2, 5):
        if first == 2 or card.word(first):
            grid, value = card.identifier(first), card.real(first + 2)
            for at in card.components(first + 1):
                before = reader.model.state.supports.get((grid, at))
                if before is None:
                    raise Fault(f"component {at + 1} of grid {grid} has no SPC", line=card.line)
                held = Value(value, before.label, card.source)
                reader.model.state.supports[grid, at] = held


@handles("MPC")
def mpc(card, reader):
    """Terms (grid, component, coefficient), two in a line; fields 8 and 9 are blank, and so is
    field 2 of further lines."""
    if selected(card, reader, reader.mpc_sets) is None:
        return
    terms = []
    for line in range(0, len(card.fields), 8):
        for first in (line + 2, line + 5):
            if not card.word(first):
                continue
            components = card.components(first + 1)
            if len(components) != 1:
                raise Fault("a term has one component", line=card.line)
            terms.append((card.identifier(first), components[0], card.real(first + 2, 0.0)))
    if not terms or terms[0][2] == 0:
        raise Fault("the first coefficient is zero", line=card.line)
    terms = reader.basic_terms([term for term in terms if term[2]])
    reader.model.equations.append(Equation(terms, card.source, True))
