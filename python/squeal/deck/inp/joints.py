# SPDX-License-Identifier: BSD-2-Clause
"""Cards that join nodes: equations, ties, springs, dashpots, masses and bolts."""
import numpy as np

from squeal.deck.inp.handlers import handles
from squeal.deck.journal import Fault, place_of
from squeal.deck.model import Bolt, Equation, Joint, PointMass, Tie
from squeal.deck.numbers import integer, real

# Of types of elements: the kind of a joint, and the number of components in its first line.
KINDS = {
    **{"SPRINGA": ("line", 0), "SPRING1": ("ground", 1), "SPRING2": ("pair", 2)},
    **{"DASHPOTA": ("line", 0), "DASHPOT1": ("ground", 1), "DASHPOT2": ("pair", 2)},
}


@handles("EQUATION")
def equation(card, reader):
    fields = [(line, field) for line, row in card.rows() for field in row]
    at = 0
    while at < len(fields):
        line, word = fields[at]
        count = integer(word, line)
        terms = fields[at + 1 : at + 1 + 3 * count]
        at += 1 + 3 * count
        if count < 1 or len(terms) < 3 * count:
            raise Fault(f"an equation of {count} terms has {3 * count} fields", line=line)
        _add_equation(card, reader, terms, line)


def _add_equation(card, reader, fields, line):
    """Sets of several nodes are paired in their order."""
    nodes = [reader.nodes_of(word, at) for at, word in fields[0::3]]
    lengths = {len(one) for one in nodes} - {1}
    if len(lengths) > 1:
        raise Fault("the sets of an equation have different numbers of nodes", line=line)
    components = [integer(word, at) - 1 for at, word in fields[1::3]]
    coefficients = [real(word, at) for at, word in fields[2::3]]
    if any(component not in range(6) for component in components):
        raise Fault("components are 1 to 6", line=line)
    if reader.scope.turned:
        raise Fault("equations in a part whose instance is turned are not supported", line=line)
    for number in range(max(lengths, default=1)):
        chosen = [int(one[number % len(one)]) for one in nodes]
        reader.model.equations.append(
            Equation(list(zip(chosen, components, coefficients)), card.source)
        )


@handles(
    "TIE",
    used=("NAME", "POSITION TOLERANCE", "ADJUST", "TYPE"),
    idle=("NO ROTATION", "NO THICKNESS"),
)
def tie(card, reader):
    stem = reader.defined(card, "NAME")[1] if "NAME" in card.parameters else "tie"
    tolerance = card.value("POSITION TOLERANCE")
    adjust = card.key("ADJUST", "YES")
    if card.key("TYPE", "NODETOSURFACE") not in ("NODETOSURFACE", "SURFACETOSURFACE"):
        raise Fault(f"TYPE={card.value('TYPE')} is not supported", "TYPE")
    if adjust not in ("YES", "NO"):
        raise Fault(f"ADJUST={adjust} is not supported", "ADJUST")
    for line, fields in card.rows():
        if len(fields) != 2:
            raise Fault("a line has the slave and the master surface", line=line)
        slave, master = (reader.surface_of(field, line) for field in fields)
        if reader.model.surfaces[master].nodes is not None:
            raise Fault(f"the master surface '{master}' has no faces", line=line)
        bound = real(tolerance) if tolerance is not None else None
        taken = {one.name for one in reader.model.ties}
        name, number = stem, 2
        while name in taken:
            name, number = f"{stem}_{number}", number + 1
        reader.model.ties.append(Tie(name, slave, master, bound, adjust == "YES", card.source))


@handles("SPRING", used=("ELSET",))
def spring(card, reader):
    _joint(card, reader, "stiffness")


@handles("DASHPOT", used=("ELSET",))
def dashpot(card, reader):
    _joint(card, reader, "damping")


def _joint(card, reader, what):
    sets = reader.model.element_sets
    label = reader.key(card, "ELSET", sets)
    kinds = reader.kinds_of(sets.members(label))
    if len(kinds) != 1 or not kinds <= set(KINDS):
        raise Fault(f"the elements of '{label}' are not of one type of springs or dashpots")
    kind, count = KINDS[kinds.pop()]
    rows = list(card.rows())
    components = _joined_components(rows, count) if count else ()
    if kind != "line" and reader.scope.turned:
        raise Fault("components of a part whose instance is turned are not supported")
    if len(rows) != 1:
        raise Fault("the stiffness must be one number on one line; others are not supported")
    line, fields = rows[0]
    value = real(fields[0], line)
    if "." not in fields[0] and what == "stiffness" and not card.dialect.short_words:
        reader.journal.choose(
            f"{place_of(card.source, line)}: {fields[0]} is read as a stiffness;"
            " CalculiX reads a number without a point as a component"
        )
    if len(fields) > 1:
        reader.journal.choose(f"{place_of(card.source, line)}: only the first number is used")
    values = {"stiffness": 0.0, "damping": 0.0, what: value}
    reader.model.joints.append(Joint(kind, label, components, source=card.source, **values))


def _joined_components(rows, count):
    """Takes the line of components, one for each end, from the lines of a card."""
    line, fields = rows.pop(0) if len(rows) > 1 else (None, [""])
    components = tuple(integer(field, line) - 1 for field in fields if field)
    if len(components) != count or any(one not in range(6) for one in components):
        ends = "one component" if count == 1 else "two components"
        raise Fault(f"the line before the stiffness has {ends}, from 1 to 6", line=line)
    return components


def _points(card, reader, kind):
    """Returns the key of ELSET, whose elements have to be of a kind. Raises Fault."""
    sets = reader.model.element_sets
    label = reader.key(card, "ELSET", sets)
    if reader.kinds_of(sets.members(label)) != {kind}:
        raise Fault(f"the elements of '{label}' are not of type {kind}")
    return label


def _refuse_second(reader, label, what):
    """Raises Fault if an element of a set already has such a property."""
    model = reader.model
    described = reader.described.setdefault(what, set())
    for element in model.element_sets.members(label).tolist():
        if element in described:
            raise Fault(f"element {model.element_label(element)} has a second {what}")
        described.add(element)


@handles("MASS", used=("ELSET",), lines=1)
def mass(card, reader):
    label = _points(card, reader, "MASS")
    line, fields = next(card.rows(), (None, [""]))
    _refuse_second(reader, label, "mass")
    reader.model.masses.append(PointMass(label, real(fields[0], line), card.source))


@handles("ROTARY INERTIA", used=("ELSET",), lines=1)
def rotary_inertia(card, reader):
    """The tensor I11, I22, I33, I12, I13, I23 about the node, in the axes of the part: products of
    inertia are negative sums, as those of the program."""
    label = _points(card, reader, "ROTARYI")
    line, fields = next(card.rows(), (None, []))
    numbers = [real(field, line) if field else 0.0 for field in fields]
    if not 1 <= len(numbers) <= 6:
        raise Fault("the line has up to six numbers", line=line)
    numbers += [0.0] * (6 - len(numbers))
    matrix = np.array(numbers)[[[0, 3, 4], [3, 1, 5], [4, 5, 2]]]
    smallest, _, largest = np.linalg.eigvalsh(matrix)
    if smallest < -1e-9 * abs(largest):
        raise Fault("the tensor of inertia has a negative principal moment", line=line)
    matrix = reader.scope.rotation @ matrix @ reader.scope.rotation.T
    _refuse_second(reader, label, "tensor of inertia")
    reader.model.masses.append(PointMass(label, 0.0, card.source, matrix))


@handles("PRE-TENSION SECTION", used=("SURFACE", "NODE"), lines=1)
def pretension_section(card, reader):
    """The line of data is the direction of the bolt, by default the normal of the surface."""
    card.require("SURFACE")
    surface = reader.surface_of(card.parameters["SURFACE"], None)
    if reader.model.surfaces[surface].nodes is not None:
        raise Fault(f"the surface '{surface}' has no faces")
    node = reader.node_of(card, "NODE")
    if any(bolt.node == node for bolt in reader.model.bolts):
        raise Fault("another bolt has the same node", "NODE")
    if reader.in_cells(node):
        raise Fault("the node belongs to a body; the elongation of a bolt needs its own", "NODE")
    normal = None
    for line, fields in card.rows():
        normal = np.array([real(field, line) if field else 0.0 for field in fields])
        if len(normal) != 3 or not np.any(normal):
            raise Fault("the line has the three components of the normal", line=line)
        normal = reader.scope.rotation @ normal
    reader.model.bolts.append(Bolt(surface, node, normal, card.source))
