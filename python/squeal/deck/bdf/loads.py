# SPDX-License-Identifier: BSD-2-Clause
"""Loads of the selected set: FORCE, MOMENT, PLOAD4, GRAV, RFORCE; LOAD joins sets with factors."""
import numpy as np

from squeal.deck.bdf.handlers import LOADS, handles
from squeal.deck.bdf.unions import in_itself, opened
from squeal.deck.journal import TRANSLATED, UNUSED, USED, Fault, Missing
from squeal.deck.model import BodyLoad, Value

SIMPLE = ("FORCE", "MOMENT", "FORCE1", "MOMENT1", "PLOAD4", "GRAV", "RFORCE", "SPCD", *LOADS)


def factors_of(reader):
    """Returns the factor of each set of loads that acts, by its number."""
    combined = {}
    for card in reader.deck.each("LOAD"):
        try:
            number, total = card.identifier(1), card.real(2)
            parts = combined.setdefault(number, {})
            for first in range(3, len(card.fields), 2):
                if card.word(first) or card.word(first + 1):
                    factor, part = card.real(first), card.identifier(first + 1)
                    parts[part] = parts.get(part, 0.0) + total * factor
            card.unread()
        except Fault as fault:
            reader.journal.refuse(card.source, fault.reason, fault.name, fault.line)
    taken = _taken(reader, combined)
    factors, unions = {}, set()
    if taken is not None:
        unions = _expand(reader, combined, taken, factors)
    elif reader.selection.everything:
        factors = dict.fromkeys(_simple(reader), 1.0)
    for card in reader.deck.each("LOAD"):
        used = card.word(1) in map(str, unions)
        remark = "" if used else f"set {card.word(1)} is not selected"
        reader.journal.mark(card.source, USED if used else UNUSED, remark)
    return factors


def _simple(reader):
    return {
        int(fields[0])
        for name in SIMPLE
        for fields, _, _ in reader.deck.rows(name)
        if fields[0].isdigit()
    }


def _taken(reader, combined):
    if not reader.selection.everything:
        return reader.selection.load
    if len(combined) > 1:
        reader.journal.refuse_model(
            "the deck has no case control and several LOAD cards: select one by LOAD ="
        )
        return None
    return next(iter(combined), None)


def _expand(reader, combined, selected, factors):
    """Adds the factors of the simple sets that a set comprises. Returns the numbers of the LOAD
    cards that join them."""
    simple, unions = opened(combined, selected)
    number = in_itself(combined, unions)
    if number is not None:
        reader.journal.refuse(reader.load_source(), f"LOAD {number} contains itself")
        return unions
    for number in sorted(simple - _simple(reader)):
        reader.journal.refuse(reader.load_source(), f"no load has the set {number}")
    weights = {selected: 1.0}
    left = set(unions)
    while tops := left.difference(*(combined[number] for number in left)):
        for union in sorted(tops):
            for part, own in combined[union].items():
                weights[part] = weights.get(part, 0.0) + weights[union] * own
        left -= tops
    factors.update((number, weights[number]) for number in simple)
    return unions


def _factor(card, reader):
    """Returns the factor of the set of a card, or None if it does not act."""
    number = card.identifier(1)
    if number in reader.load_factors:
        reader.journal.mark(card.source, TRANSLATED)
        return reader.load_factors[number]
    reader.journal.mark(card.source, UNUSED, f"set {number} is not selected")
    card.read.update(range(1, len(card.fields) + 1))
    return None


def _push(card, reader, grid, vector, first):
    """Adds a force, or from component 3 on a moment, in global axes."""
    forces = reader.model.state.forces
    for at, value in enumerate(vector, first):
        before = forces.get((grid, at))
        if value or before is not None:
            total = value + (before.value if before is not None else 0.0)
            forces[grid, at] = Value(total, None, card.source)


@handles("FORCE", "MOMENT")
def force(card, reader):
    factor = _factor(card, reader)
    if factor is None:
        return
    grid, system, size = card.identifier(2), card.integer(3, 0), card.real(4)
    place = reader.model.nodes.at([grid])[0]
    vector = reader.systems.vector(system, card.reals(5, 3, 0.0), place)
    _push(card, reader, grid, factor * size * vector, 0 if card.name == "FORCE" else 3)


@handles("FORCE1", "MOMENT1")
def force_along(card, reader):
    factor = _factor(card, reader)
    if factor is None:
        return
    grid, size = card.identifier(2), card.real(3)
    ends = reader.model.nodes.at([card.identifier(4), card.identifier(5)])
    direction = ends[1] - ends[0]
    length = np.linalg.norm(direction)
    if length == 0:
        raise Fault("the two grids coincide", line=card.line)
    first = 0 if card.name == "FORCE1" else 3
    _push(card, reader, grid, factor * size * direction / length, first)


@handles("GRAV")
def gravity(card, reader):
    factor = _factor(card, reader)
    if factor is None:
        return
    vector = card.real(3) * reader.systems.vector(card.integer(2, 0), card.reals(4, 3, 0.0))
    if card.integer(7, 0) not in (0, -1):
        raise Fault("MB is 0 or -1", line=card.line)
    before = reader.model.state.gravity
    total = factor * vector + (before[0] if before is not None else 0.0)
    reader.model.state.gravity = total, card.source


@handles("RFORCE", phase=3)
def rotation(card, reader):
    factor = _factor(card, reader)
    if factor is None:
        return
    if card.real(9, 0.0):
        raise Fault("RACC: forces of an angular acceleration are not supported", "RACC", card.line)
    if card.integer(8, 1) not in (1, 2) or card.integer(10, 0) not in (0, -1):
        raise Fault("METHOD is 1 or 2, and MB 0 or -1", line=card.line)
    if factor < 0:
        raise Fault("the factor of a centrifugal force is negative", line=card.line)
    if reader.model.inertias:
        reader.journal.refuse(card.source, "CONM2 would have no centrifugal force", "CONM2")
    grid = card.integer(2, 0)
    origin = reader.model.nodes.at([grid])[0] if grid else np.zeros(3)
    vector = reader.systems.vector(card.integer(3, 0), card.reals(5, 3, 0.0))
    length = np.linalg.norm(vector)
    speed = 2 * np.pi * card.real(4, 0.0) * length * np.sqrt(factor)
    if speed:
        load = BodyLoad("CENTRIF", reader.cells, vector / length, speed, card.source, origin)
        reader.model.state.body_loads.append(load)


@handles("PLOAD4")
def pressure(card, reader):
    factor = _factor(card, reader)
    if factor is None:
        return
    amount = card.real(3, 0.0)
    if any(card.real(number, amount) != amount for number in (4, 5, 6)):
        raise Fault("a pressure that varies over a face is not supported", line=card.line)
    if any(card.word(number) for number in (9, 10, 11, 12)):
        reason = "a load along a direction (N1, N2, N3) is not supported; use FORCE"
        raise Fault(reason, "N1", card.line)
    card.pass_over(13)  # line loads of shells
    card.pass_over(14)
    element = card.identifier(2)
    if card.word(7) == "THRU":
        raise Fault("THRU is for shells; solid elements need their face", line=card.line)
    face = _face(card, reader, element)
    if face is None:
        return
    pressures = reader.model.state.pressures
    before = pressures.get((element, face))
    total = factor * amount + (before.value if before is not None else 0.0)
    pressures[element, face] = Value(total, f"PLOAD4_{card.word(1)}", card.source)


def _face(card, reader, element):
    """Returns the number of the face from 0 that contains the grid G1, and the opposite corner G3
    of a quadrilateral, or that lies opposite to the corner G4 of a tetrahedron."""
    try:
        shape, nodes = reader.solid(element, card.line)
    except Missing:
        if reader.journal.incomplete:
            return None
        raise
    first, other = card.identifier(7), card.identifier(8, None)
    fitting = []
    for number, corners in enumerate(shape.corners):
        on = [nodes[at] for at in corners]
        if first not in on:
            continue
        if shape.name in ("tet4", "tet10"):
            fits = other is not None and other in nodes[:4] and other not in on
        elif other is None:
            fits = len(on) == 3
        elif len(on) == 4:
            fits = other in on and abs(on.index(first) - on.index(other)) == 2
        else:
            fits = shape.name[:7] == "pyramid" and other in on and other != first
        if fits:
            fitting.append(number)
    if len(fitting) != 1:
        raise Fault(
            f"the grids of fields 8 and 9 name no face of element {element}", line=card.line
        )
    return fitting[0]
