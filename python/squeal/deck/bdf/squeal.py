# SPDX-License-Identifier: BSD-2-Clause
"""Brake squeal of MSC Nastran: BSQUEAL, or BRKSYS with BRKPROP and MOTION, to a motion, a stiffness
of contact and a request for complex modes.

Neither card gives a speed: it is that of the user, or only the direction counts.
"""
from dataclasses import dataclass, field

import numpy as np

from squeal.deck.bdf.contacts import parameters_of
from squeal.deck.bdf.handlers import handles
from squeal.deck.bdf.regions import region_of
from squeal.deck.journal import TRANSLATED, UNUSED, USED, Fault, Source
from squeal.deck.mesh import EMPTY, Surface
from squeal.deck.model import Motion, Squeal

ROUND = 60.0  # largest gap between the nodes of a disc around its axis, in degrees


@dataclass
class Brake:
    """A pair of bodies that rub; `friction` None: that of the contact."""

    bodies: tuple
    axis: np.ndarray
    origin: np.ndarray
    stiffness: float
    source: Source
    friction: float = None
    interactions: list = field(default_factory=list)

    @property
    def line(self):
        return self.source.line


@handles("BRKPROP")
def brkprop(card, reader):
    number = card.identifier(1)
    given = parameters_of(card, 2)
    for name, value in given.items():
        if name not in ("AVSTIF", "FRICT") and value not in ("0", "0."):
            reader.journal.refuse(card.source, f"{name} is not supported", name, card.line)
    reader.brake_properties[number] = {
        name: float(value) for name, value in _reals(given, card).items()
    }
    reader.journal.mark(card.source, USED)


def _reals(given, card):
    known = {name: value for name, value in given.items() if name in ("AVSTIF", "FRICT")}
    for at in range(1, len(card.fields) + 1):
        if card.word(at) in known:
            known[card.word(at)] = card.real(at + 1)
    return known


@handles("MOTION")
def motion(card, reader):
    """The axis of a rotation, and a velocity that Nastran does not use."""
    number, velocity = card.identifier(1), card.real(2, 0.0)
    if card.word(9) != "ROTAT":
        raise Fault("only FORM ROTAT is supported", "FORM", card.line)
    axis, origin = np.array(card.reals(10, 3, 0.0)), np.array(card.reals(13, 3, 0.0))
    if not np.any(axis):
        raise Fault("the axis is zero", line=card.line)
    axis = axis / np.linalg.norm(axis) * (-1 if velocity < 0 else 1)
    reader.brake_motions[number] = axis, origin
    reader.journal.mark(card.source, USED)


def _wanted(card, reader):
    number = card.identifier(1)
    if reader.selection.everything or number == reader.selection.squeal:
        return True
    reader.journal.mark(card.source, UNUSED, f"set {number} is not selected")
    card.read.update(range(1, len(card.fields) + 1))
    return False


def _at_end(card, number):
    """The modes are those of the state under the full load."""
    factor = card.real(number, 0.0)
    if factor not in (0.0, 1.0):
        raise Fault(f"OMETH {factor:g}: only the full load is supported", "OMETH", card.line)


@handles("BRKSYS", phase=3)
def brksys(card, reader):
    if not _wanted(card, reader):
        return
    _at_end(card, 2)
    if card.integer(3, 0) or card.integer(5, 0):
        raise Fault("IVEC and ISLIDEBS must be 0", "IVEC", card.line)
    card.pass_over(4)  # whether the solution goes on afterwards
    for line in range(8, len(card.fields), 8):
        if not any(card.word(at) for at in range(line + 1, line + 9)):
            continue
        bodies = card.identifier(line + 2), card.identifier(line + 3)
        first = card.identifier(line + 4)
        second = card.identifier(line + 5, first)
        number = card.identifier(line + 6)
        for one in (first, second):
            if one not in reader.brake_motions:
                raise Fault(f"there is no MOTION {one}", line=card.line)
        if number not in reader.brake_properties:
            raise Fault(f"there is no BRKPROP {number}", line=card.line)
        own = reader.brake_properties[number]
        axis, origin = reader.brake_motions[first]
        other = reader.brake_motions[second]
        if not (np.allclose(axis, other[0]) and np.allclose(np.cross(origin - other[1], axis), 0)):
            raise Fault("two different motions of a pair are not supported", "MOTION", card.line)
        brake = Brake(bodies, axis, origin, own.get("AVSTIF"), card.source, own.get("FRICT"))
        reader.squeals[frozenset(bodies)] = brake
    reader.journal.mark(card.source, TRANSLATED)


@handles("BSQUEAL", phase=3)
def bsqueal(card, reader):
    """One axis for all pairs with friction; known when the contacts are."""
    if not _wanted(card, reader):
        return
    _at_end(card, 2)
    stiffness = card.real(3)
    card.pass_over(6)
    axis, origin = np.array(card.reals(9, 3, 0.0)), np.array(card.reals(12, 3, 0.0))
    if not np.any(axis):
        raise Fault("the axis is zero", line=card.line)
    axis = axis / np.linalg.norm(axis)
    reader.all_squeal = Brake((), axis, origin, stiffness, card.source)
    reader.journal.mark(card.source, TRANSLATED)


def finish(reader):
    """Adds motions and the request for complex modes, when all contacts are known."""
    model = reader.model
    brakes = list(reader.squeals.values())
    if reader.all_squeal is not None:
        brakes.append(_of_all(reader))
    brakes = [one for one in brakes if one is not None]
    if not brakes:
        return
    laws, moved = {}, {}
    for one in brakes:
        try:
            if not one.interactions:
                raise Fault("no contact with friction has these bodies")
            for key in one.interactions:
                laws.update({key: law for law in model.interactions[key].frictions})
            nodes = _nodes(reader, _disc(reader, one), one)
            before = moved.setdefault(nodes.tobytes(), one)
            if before is one:
                motion = Motion(nodes, 1.0, one.source, one.axis, one.origin, known=False)
                model.motions.append(motion)
            elif not np.allclose(before.axis, one.axis):
                raise Fault("a disc has two motions", "MOTION")
        except Fault as fault:
            reader.journal.refuse(one.source, fault.reason, fault.name)
    if laws:
        model.squeal.append(Squeal(brakes[0].source, laws, False))


def _of_all(reader):
    """Returns the brake of BSQUEAL: all contacts with friction, of which one body is the disc."""
    brake, model = reader.all_squeal, reader.model
    rubbing = [one for one in model.contacts if model.interactions[one.interaction].frictions]
    brake.interactions = [one.interaction for one in rubbing]
    for key in brake.interactions:
        model.interactions[key].stiffness = brake.stiffness
        model.interactions[key].behavior = brake.source
    names = {key for one in rubbing for key in (one.slave, one.master)}
    brake.bodies = tuple(sorted(names))
    return brake


def _disc(reader, brake):
    """Returns the body, or the surface, whose nodes go around the axis. Raises Fault."""
    around = {}  # by their nodes: surfaces may belong to one body
    for one in brake.bodies:
        nodes = _nodes(reader, one, brake)
        if _goes_around(nodes, reader, brake):
            around.setdefault(nodes.tobytes(), one)
    if len(around) != 1:
        raise Fault(
            f"{len(around)} of the bodies in contact go around the axis; the disc is not determined"
        )
    disc = next(iter(around.values()))
    reader.journal.choose(
        f"{brake.source}: the body that moves is that of"
        f" {disc if isinstance(disc, str) else f'contact body {disc}'}, which goes around the axis"
    )
    return disc


def _nodes(reader, one, brake):
    """Returns the nodes of a body, or of the body of a surface."""
    model = reader.model
    if isinstance(one, str):
        elements = model.surfaces[one].elements
        elements = _whole(reader, elements)
    else:
        found = region_of(reader, one, brake)
        elements = _whole(reader, found.elements) if isinstance(found, Surface) else found[1]
    blocks, rows = model.find_elements(elements)
    parts = [b.nodes[rows[blocks == at]].ravel() for at, b in enumerate(model.blocks)]
    return np.unique(np.concatenate([EMPTY, *parts]))


def _whole(reader, elements):
    """Returns the elements of the properties of some elements."""
    tables = reader.solids.tables.values()
    owners = np.unique(np.concatenate([EMPTY, *(t[np.isin(t[:, 0], elements), 1] for t in tables)]))
    return np.concatenate([EMPTY, *(t[np.isin(t[:, 1], owners), 0] for t in tables)])


def _goes_around(nodes, reader, brake):
    places = reader.model.nodes.at(nodes) - brake.origin
    helper = np.eye(3)[int(np.argmin(np.abs(brake.axis)))]
    x = np.cross(brake.axis, helper)
    angles = np.sort(np.degrees(np.arctan2(places @ np.cross(brake.axis, x), places @ x)))
    gaps = np.diff(np.concatenate([angles, angles[:1] + 360]))
    return bool(len(angles) > 2 and gaps.max() < ROUND)
