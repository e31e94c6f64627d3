# SPDX-License-Identifier: BSD-2-Clause
"""Cards that join nodes: equations, rigid bodies, couplings, ties, springs and masses."""
import numpy as np

from squeal.deck.inp.handlers import handles
from squeal.deck.journal import Fault
from squeal.deck.model import Equation, Joint, Mean, PointMass, Rigid, Tie
from squeal.deck.numbers import integer, real


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
    for number in range(max(lengths, default=1)):
        chosen = [int(one[number % len(one)]) for one in nodes]
        reader.model.equations.append(
            Equation(list(zip(chosen, components, coefficients)), card.source)
        )


@handles("RIGID BODY", used=("NSET", "ELSET", "REF NODE", "ROT NODE"), lines=0)
def rigid_body(card, reader):
    if ("NSET" in card.parameters) == ("ELSET" in card.parameters):
        raise Fault("either NSET= or ELSET= is needed")
    if "NSET" in card.parameters:
        label = card.key("NSET")
        nodes = reader.model.node_sets.members(label)
    else:
        label = card.key("ELSET")
        nodes = reader.nodes_of_elements(reader.model.element_sets.members(label))
    if not len(nodes):
        raise Fault(f"the set '{label}' is empty")
    if "REF NODE" not in card.parameters:
        raise Fault("a rigid body without REF NODE= is not supported")
    reference = integer(card.require("REF NODE"))
    rotation = card.value("ROT NODE")
    if rotation is not None:
        rotation = integer(rotation)
    reader.model.nodes.at([reference])
    reader.model.rigid.append(Rigid(label, nodes, reference, card.source, rotation))


@handles(
    "COUPLING", used=("REF NODE", "SURFACE", "CONSTRAINT NAME", "ORIENTATION"), idle=(), lines=0
)
def coupling(card, reader):
    """Completed by *KINEMATIC."""
    name, surface = card.require("CONSTRAINT NAME"), card.key("SURFACE")
    if surface not in reader.model.surfaces:
        raise Fault(f"there is no surface '{surface}'")
    frame = None
    if "ORIENTATION" in card.parameters:
        frame = reader.model.orientations.get(card.key("ORIENTATION"))
        if frame is None:
            raise Fault(f"there is no orientation '{card.key('ORIENTATION')}' before this card")
    reference = integer(card.require("REF NODE"))
    reader.model.nodes.at([reference])
    reader.model.rigid.append(
        Rigid(surface, None, reference, card.source, None, name, surface, (), frame)
    )


@handles("KINEMATIC")
def kinematic(card, reader):
    one = reader.model.rigid[-1] if reader.model.rigid else None
    if one is None or one.name is None or one.components:
        raise Fault("this card belongs after *COUPLING")
    components = set()
    for line, fields in card.rows():
        first = integer(fields[0], line)
        last = integer(fields[1], line) if len(fields) > 1 and fields[1] else first
        if not 1 <= first <= last <= 3:
            raise Fault("components are 1 to 3; rotations follow from them", line=line)
        components.update(range(first - 1, last))
    if not components:
        raise Fault("there is no line of components")
    one.components = tuple(sorted(components))


@handles("DISTRIBUTING", idle=None)
def distributing(card, reader):
    if reader.model.rigid and reader.model.rigid[-1].name and not reader.model.rigid[-1].components:
        reader.model.rigid.pop()
    raise Fault(
        "CalculiX distributes forces over the surface by areas, and its reference node does not"
        " move; this is not supported"
    )


@handles("DISTRIBUTING COUPLING", used=("ELSET",))
def distributing_coupling(card, reader):
    """In CalculiX the displacement of the node of DCOUP3D is the weighted mean, without moments."""
    elements = reader.model.element_sets.members(card.key("ELSET"))
    references = reader.nodes_of_elements(elements, "DCOUP3D")
    if len(references) != 1:
        raise Fault("ELSET= must contain one element of type DCOUP3D")
    nodes, weights = [], []
    for line, fields in card.rows():
        if len(fields) != 2:
            raise Fault("a line has a node or node set and a weight", line=line)
        nodes.append(reader.nodes_of(fields[0], line))
        weights.append(np.full(len(nodes[-1]), real(fields[1], line)))
    if not nodes or np.concatenate(weights).sum() == 0:
        raise Fault("the weights have the sum zero")
    reader.model.means.append(
        Mean(int(references[0]), np.concatenate(nodes), np.concatenate(weights), card.source)
    )


@handles("TIE", used=("NAME", "POSITION TOLERANCE", "ADJUST"))
def tie(card, reader):
    stem = card.value("NAME") or "tie"
    tolerance = card.value("POSITION TOLERANCE")
    adjust = card.key("ADJUST", "YES")
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
    label = card.key("ELSET")
    kinds = reader.kinds_of(reader.model.element_sets.members(label))
    rows = list(card.rows())
    if kinds <= {"SPRINGA", "DASHPOTA"} and len(kinds) == 1:
        kind, component = "line", None
    elif kinds == {"SPRING1"}:
        kind = "ground"
        line, fields = rows.pop(0) if len(rows) > 1 else (None, [""])
        component = integer(fields[0], line) - 1
        if component not in range(3):
            raise Fault("the component of a spring to the ground is 1, 2 or 3", line=line)
    else:
        raise Fault(f"the elements of '{label}' are not of one type of springs or dashpots")
    if len(rows) != 1:
        raise Fault("the stiffness must be one number on one line; others are not supported")
    line, fields = rows[0]
    value = real(fields[0], line)
    if "." not in fields[0] and what == "stiffness":
        reader.journal.choose(
            f"{card.source.file}:{line}: {fields[0]} is read as a stiffness;"
            f" {card.dialect.name} reads a number without a point as a component"
        )
    if len(fields) > 1:
        reader.journal.choose(f"{card.source.file}:{line}: only the first number is used")
    values = {"stiffness": 0.0, "damping": 0.0, what: value}
    reader.model.joints.append(Joint(kind, label, component, source=card.source, **values))


@handles("MASS", used=("ELSET",), lines=1)
def mass(card, reader):
    label = card.key("ELSET")
    if reader.kinds_of(reader.model.element_sets.members(label)) != {"MASS"}:
        raise Fault(f"the elements of '{label}' are not of type MASS")
    line, fields = next(card.rows(), (None, [""]))
    reader.model.masses.append(PointMass(label, real(fields[0], line), card.source))
