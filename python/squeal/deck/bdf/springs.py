# SPDX-License-Identifier: BSD-2-Clause
"""Springs, dampers, bushings and point masses: CELAS1, CELAS2, CDAMP1, CDAMP2, CBUSH, CONM2, with
PELAS, PDAMP and PBUSH."""
import numpy as np

from squeal.deck.attachments import Bushing, PointInertia
from squeal.deck.axes import Frame
from squeal.deck.bdf.handlers import handles
from squeal.deck.journal import UNUSED, USED, Fault
from squeal.deck.model import Equation

COINCIDENT = 1e-4  # distance below which the ends of CBUSH coincide for Nastran


@handles("PELAS", phase=0)
def pelas(card, reader):
    for first in (1, 5):
        if first == 1 or card.word(first):
            values = card.real(first + 1), _loss(card, first + 2, reader)
            _property(card, reader, "PELAS", card.identifier(first), values)
            card.pass_over(first + 3)  # coefficient of stresses


@handles("PDAMP", phase=0)
def pdamp(card, reader):
    for first in (1, 3, 5, 7):
        if first == 1 or card.word(first):
            _property(card, reader, "PDAMP", card.identifier(first), card.real(first + 1))


@handles("PBUSH", phase=0)
def pbush(card, reader):
    """Each line has a word and up to six values."""
    values = {"K": np.zeros(6), "B": np.zeros(6), "GE": None}
    number = card.identifier(1)
    for line in range(0, len(card.fields), 8):
        at = line + 2
        if line and card.word(line + 1):
            at = line + 1
        word = card.word(at)
        if word in values:
            given = [card.real(one, None) for one in range(at + 1, at + 7)]
            if word == "GE" and given[0] is not None and all(one is None for one in given[1:]):
                given = [given[0]] * 6
            values[word] = np.array([one or 0.0 for one in given])
        elif word in ("RCV", "T"):
            for one in range(at + 1, at + 5):
                card.pass_over(one)
            reader.journal.remark(card.source, f"{word} is not used")
        elif word == "M":
            if card.real(at + 1, 0.0):
                raise Fault("the mass of a bushing is not supported; use CONM2", "M", card.line)
        elif word:
            raise Fault(f"'{word}' is not supported", word, card.line)
    if np.any(values["K"] < 0) or np.any(values["B"] < 0):
        raise Fault("a stiffness or a damping is negative", line=card.line)
    if values["GE"] is not None and np.any(values["GE"]):
        values["B"] = values["B"] + _viscous(card, values["GE"], values["K"], reader)
    _property(card, reader, "PBUSH", number, (values["K"], values["B"]))


def _property(card, reader, kind, number, values):
    if (kind, number) in reader.constants:
        raise Fault(f"property {number} is defined twice", line=card.line)
    reader.constants[kind, number] = values
    reader.journal.mark(card.source, USED)


def _loss(card, number, reader):
    return card.real(number, 0.0)


def _viscous(card, factor, stiffness, reader):
    """Returns the damping that equals a structural damping at the frequency of PARAM,W4."""
    if not reader.selection.complex:
        reader.journal.remark(card.source, "GE is not used: modes without damping are computed")
    elif reader.parameters.get("W4"):
        return factor * stiffness / reader.parameters["W4"]
    else:
        reader.journal.refuse(
            card.source,
            "structural damping needs the frequency at which it is exact: give PARAM,W4 in rad/s",
            "GE",
        )
    return 0.0 * stiffness


def _constant(card, reader, kind, number):
    if (kind, number) not in reader.constants:
        raise Fault(f"there is no {kind} {number}", line=card.line)
    return reader.constants[kind, number]


@handles("CELAS1")
def celas1(card, reader):
    number = card.identifier(1)
    stiffness, loss = _constant(card, reader, "PELAS", card.identifier(2, number))
    damping = _viscous(card, loss, stiffness, reader) if loss else 0.0
    _scalar(card, reader, number, (stiffness, damping))


@handles("CELAS2")
def celas2(card, reader):
    stiffness, loss = card.real(2), card.real(7, 0.0)
    card.pass_over(8)  # coefficient of stresses
    damping = _viscous(card, loss, stiffness, reader) if loss else 0.0
    _scalar(card, reader, card.identifier(1), (stiffness, damping))


@handles("CDAMP1")
def cdamp1(card, reader):
    number = card.identifier(1)
    damping = _constant(card, reader, "PDAMP", card.identifier(2, number))
    _scalar(card, reader, number, (0.0, damping))


@handles("CDAMP2")
def cdamp2(card, reader):
    _scalar(card, reader, card.identifier(1), (0.0, card.real(2)))


def _scalar(card, reader, number, values):
    """A spring and a damper between two components, or one and the ground."""
    ends = []
    for first in (3, 5):
        grid = card.integer(first, 0)
        if grid:
            components = card.components(first + 1, ())
            if len(components) != 1:
                raise Fault("an end is a grid and one component", line=card.line)
            reader.model.nodes.at([grid])
            ends.append((grid, components[0]))
        elif card.word(first + 1, "0") != "0":
            raise Fault("a component has no grid", line=card.line)
    if not ends or len(set(ends)) < len(ends):
        raise Fault("the two ends must be different", line=card.line)
    if min(values) < 0:
        raise Fault("a stiffness or a damping is negative", line=card.line)
    if not any(values):
        reader.journal.mark(card.source, UNUSED, "its constants are zero")
        return
    name, model = f"{card.name.lower()}_{number}", reader.model
    (grid, component) = ends[0]
    frame, second = model.frames.get(grid), None
    if len(ends) == 2:
        second = ends[1][0]
        places = model.nodes.at([grid, second])
        same = np.allclose(reader.axes_at(grid), reader.axes_at(second), atol=1e-12)
        apart = np.linalg.norm(places[1] - places[0])
        if ends[1][1] != component or not same or apart > 1e-9 * np.max(np.abs(places)):
            grid, component, frame = _difference(card, reader, name, ends), 0, None
            second = None
    vectors = np.zeros((2, 6))
    vectors[:, component] = values
    model.bushings.append(Bushing(name, grid, second, *vectors, frame, card.source))


def _difference(card, reader, name, ends):
    """Returns a new node whose component x is the difference of two components."""
    model = reader.model
    number = reader.new_node(model.nodes.at([ends[0][0]])[0])
    (first, one), (second, two) = ends
    terms = reader.basic_terms([(first, one, 1.0), (second, two, -1.0)])
    terms = [(number, 0, 1.0), *((node, at, -value) for node, at, value in terms)]
    model.equations.append(Equation(terms, card.source, True, f"{name}_difference"))
    return number


@handles("CBUSH")
def cbush(card, reader):
    number, model = card.identifier(1), reader.model
    stiffness, damping = _constant(card, reader, "PBUSH", card.identifier(2, number))
    first, second = card.identifier(3), card.identifier(4, None)
    places = model.nodes.at([first] if second is None else [first, second])
    line = places[-1] - places[0]
    apart = np.linalg.norm(line) >= COINCIDENT
    if second == first:
        raise Fault("the two ends must be different", line=card.line)
    location = card.real(9, 0.5)
    if card.integer(10, -1) != -1:
        raise Fault("an offset (OCID) is not supported", "OCID", card.line)
    for at in (11, 12, 13):
        card.pass_over(at)
    frame, along = _bushing_axes(card, reader, first, line if apart else None)
    transverse = np.any((stiffness + damping)[[1, 2, 4, 5]]) or not along and apart
    if along and frame is None and transverse:
        raise Fault("K2, K3, K5 and K6 need an orientation", line=card.line)
    if apart and transverse:
        inside = reader.without_rotations(np.array([first, second]))
        if np.any(inside) or location != 0.5:
            raise Fault(
                "ends that are apart must be grids with rotations, and S must be 0.5, for stiffness"
                " across their line",
                line=card.line,
            )
    if not np.any(stiffness) and not np.any(damping):
        reader.journal.mark(card.source, UNUSED, "its constants are zero")
        return
    if frame is None and along:
        frame = _along(number, line, _across(line), card.source)
    name = f"cbush_{number}"
    arms = bool(apart and transverse)
    model.bushings.append(
        Bushing(name, first, second, stiffness, damping, frame, card.source, arms)
    )


def _bushing_axes(card, reader, first, line):
    """Returns the frame of a bushing, None for global axes or for no orientation, and whether its
    x axis is the line of its ends."""
    number = card.identifier(1)
    system = card.integer(8, None)
    given = [card.word(at) for at in (5, 6, 7)]
    if system is not None:
        if system == 0:
            return None, False
        axes = reader.systems.at(system).axes_at(reader.model.nodes.at([first])[0])
        return Frame(f"cbush_{number}", False, axes[0], axes[1], card.source), False
    if line is None:
        raise Fault("ends that coincide, or the ground, need CID", line=card.line)
    if not any(given):
        return None, True
    if given[0] and not any(given[1:]) and "." not in given[0]:
        places = reader.model.nodes.at([first, card.identifier(5)])
        vector = places[1] - places[0]
    else:
        vector = np.array(card.reals(5, 3, 0.0)) @ reader.axes_at(first)
    return _along(number, line, vector, card.source), True


def _across(line):
    """Returns a direction that is not along a line."""
    return np.eye(3)[int(np.argmin(np.abs(line)))]


def _along(number, line, vector, source):
    frame = Frame(f"cbush_{number}", False, line, vector, source)
    frame.axes_at(line)
    return frame


@handles("CONM2")
def conm2(card, reader):
    number, grid, system = card.identifier(1), card.identifier(2), card.integer(3, 0)
    if number in reader.mass_numbers:
        raise Fault(f"mass {number} is defined twice", line=card.line)
    reader.mass_numbers.add(number)
    mass, offset = card.real(4, 0.0), np.array(card.reals(5, 3, 0.0))
    place = reader.model.nodes.at([grid])[0]
    axes = np.eye(3)
    if system == -1:
        offset = offset - place
    else:
        axes = reader.systems.at(system).axes_at(place)
        offset = offset @ axes
    one, product12, two, product13, product23, three = card.reals(9, 6, 0.0)
    # The fields of products are positive sums, ∫ x y dm; the tensor has them with a minus.
    inertia = np.array(
        [
            [one, -product12, -product13],
            [-product12, two, -product23],
            [-product13, -product23, three],
        ]
    )
    inertia = axes.T @ inertia @ axes
    factor = reader.mass_factor
    if mass == 0 and not np.any(inertia):
        reader.journal.mark(card.source, UNUSED, "the mass is zero")
        return
    name = f"conm2_{number}"
    new = PointInertia(name, grid, factor * mass, offset, factor * inertia, card.source)
    if grid in reader.masses:
        at = reader.masses[grid]
        other = reader.model.inertias[at]
        reader.model.inertias[at] = other.joined(new)
        reader.journal.mark(card.source, USED, f"joined with {other.name}")
        return
    reader.masses[grid] = len(reader.model.inertias)
    reader.model.inertias.append(new)
