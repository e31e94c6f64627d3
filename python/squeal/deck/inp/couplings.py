# SPDX-License-Identifier: BSD-2-Clause
"""Cards that couple nodes with a reference node: rigid bodies, couplings, constraints of points."""
import numpy as np

from squeal.deck.attachments import Distributed
from squeal.deck.inp.dialect import ABAQUS
from squeal.deck.inp.handlers import handles
from squeal.deck.journal import Fault
from squeal.deck.model import Equation, Mean, Rigid
from squeal.deck.numbers import integer, real

METHODS = ("UNIFORM", "LINEAR", "QUADRATIC", "CUBIC")
FREE = "rotations that some nodes share with a reference node, and others do not, are not supported"


@handles(
    "RIGID BODY",
    used=("NSET", "ELSET", "PIN NSET", "TIE NSET", "REF NODE", "ROT NODE", "POSITION"),
    idle=("ISOTHERMAL",),
    lines=0,
)
def rigid_body(card, reader):
    """With PIN NSET the rotations of its nodes stay free; only reference nodes have some."""
    sets = reader.model.node_sets
    given = [name for name in ("NSET", "PIN NSET", "TIE NSET", "ELSET") if name in card.parameters]
    if not given or "NSET" in given and len(given) > 1:
        raise Fault("either NSET= or ELSET= is needed")
    if card.key("POSITION", "INPUT") != "INPUT":
        raise Fault("the reference node keeps its place; others are not supported", "POSITION")
    parts = []
    for name in given:
        if name == "ELSET":
            key = reader.key(card, name, reader.model.element_sets)
            parts.append(reader.model.nodes_of_elements(reader.model.element_sets.members(key)))
        else:
            key = reader.key(card, name, sets)
            parts.append(sets.members(key))
        if not len(parts[-1]):
            raise Fault(f"the set '{key}' is empty")
    if "REF NODE" not in card.parameters:
        raise Fault("a rigid body without REF NODE= is not supported")
    one = Rigid(key, np.concatenate(parts), reader.node_of(card, "REF NODE"), card.source)
    if "ROT NODE" in card.parameters:
        one.rotation = reader.node_of(card, "ROT NODE")
    if "PIN NSET" in given:
        if len(given) > 1:
            _require_no_rotations(parts[given.index("PIN NSET")], reader)
        one.pinned = len(given) == 1
    reader.model.rigid.append(one)


def _require_no_rotations(nodes, reader):
    """Raises Fault for nodes outside the cells, which have rotations."""
    if not np.all(reader.in_cells(nodes)):
        raise Fault(FREE)


@handles(
    "COUPLING",
    used=("REF NODE", "SURFACE", "CONSTRAINT NAME", "ORIENTATION", "INFLUENCE RADIUS"),
    lines=0,
)
def coupling(card, reader):
    """Completed by *KINEMATIC or *DISTRIBUTING."""
    _, name = reader.defined(card, "CONSTRAINT NAME")
    surface = reader.key(card, "SURFACE", reader.model.surfaces)
    if surface not in reader.model.surfaces:
        raise Fault(f"there is no surface '{surface}'")
    frame = _frame_of(card, reader)
    reference = reader.node_of(card, "REF NODE")
    one = Rigid(surface, None, reference, card.source, None, name, surface, (), frame)
    if card.key("INFLUENCE RADIUS", "WORLD") != "WORLD":
        one.radius = real(card.require("INFLUENCE RADIUS"))
    reader.model.rigid.append(one)


def _frame_of(card, reader):
    """Returns the axes of ORIENTATION, or None without it. Raises Fault."""
    if "ORIENTATION" not in card.parameters:
        return None
    key = reader.key(card, "ORIENTATION", reader.model.orientations)
    if key not in reader.model.orientations:
        raise Fault(f"no card before this one defines the orientation '{key}'")
    return reader.model.orientations[key]


def _open_coupling(reader):
    refusals = reader.journal.refusals
    if refusals and refusals[-1].source.card == "COUPLING":
        raise Fault("its *COUPLING is refused")
    one = reader.model.rigid[-1] if reader.model.rigid else None
    if one is None or one.name is None or one.components:
        raise Fault("this card belongs after *COUPLING")
    return one


def _components(card):
    """Returns the components of lines `first, last`; without a line all."""
    components = set()
    for line, fields in card.rows():
        first = integer(fields[0], line)
        last = integer(fields[1], line) if len(fields) > 1 and fields[1] else first
        if not 1 <= first <= last <= 6:
            raise Fault("components are 1 to 6", line=line)
        components.update(range(first - 1, last))
    return components or set(range(6))


def _couple(one, components, reader):
    """Sets the coupled components: rotations of solid cells follow from their displacements."""
    one.components = tuple(sorted(components & {0, 1, 2}))
    rotations = components & {3, 4, 5}
    if not one.components:
        raise Fault("rotations without displacements are not supported")
    one.pinned = not rotations
    one.mixed = rotations not in (set(), {3, 4, 5})
    if len(one.components) < 3 and one.frame is None and reader.scope.turned:
        raise Fault("components of a part that is turned need an ORIENTATION")


@handles("KINEMATIC")
def kinematic(card, reader):
    one = _open_coupling(reader)
    if not card.data:
        reader.journal.choose(f"{card.source}: without a line of components all are coupled")
    _couple(one, _components(card), reader)


@handles("DISTRIBUTING", used=("WEIGHTING METHOD", "COUPLING"))
def distributing(card, reader):
    """In Abaqus the reference node follows the mean motion of the surface."""
    one = _open_coupling(reader)
    try:
        reader.decide()
        if reader.dialect is not ABAQUS:
            raise Fault(
                "CalculiX distributes forces over the surface by areas, and its reference node does"
                " not move; this is not supported"
            )
        method = card.key("WEIGHTING METHOD", "UNIFORM")
        if method not in METHODS:
            raise Fault(f"WEIGHTING METHOD={method} is not supported", "WEIGHTING METHOD")
        if card.key("COUPLING", "CONTINUUM") != "CONTINUUM":
            raise Fault("only COUPLING=CONTINUUM is supported", "COUPLING")
        if reader.model.surfaces[one.surface].areas_differ:
            raise Fault("nodes with different areas in *SURFACE, TYPE=NODE are not supported")
        if _components(card) != set(range(6)):
            raise Fault("a reference node whose rotations are free is not supported")
    except Fault:
        reader.model.rigid.pop()
        raise
    one.components, one.weighting = (0, 1, 2), method


@handles("DISTRIBUTING COUPLING", used=("ELSET",))
def distributing_coupling(card, reader):
    """In Abaqus the node of DCOUP3D follows the weighted mean motion of others; in CalculiX its
    displacement is the weighted mean, without moments."""
    reader.decide()
    sets = reader.model.element_sets
    elements = sets.members(reader.key(card, "ELSET", sets))
    references = reader.model.nodes_of_elements(elements, "DCOUP3D")
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
    nodes, weights = np.concatenate(nodes), np.concatenate(weights)
    if reader.dialect is not ABAQUS:
        reader.model.means.append(Mean(int(references[0]), nodes, weights, card.source))
        return
    if np.any(weights < 0):
        raise Fault("negative weights are not supported")
    used = weights > 0
    name = f"coupling_{card.source.line}"
    reader.model.distributed.append(
        Distributed(name, int(references[0]), nodes[used], weights[used], card.source)
    )


@handles("KINEMATIC COUPLING", used=("REF NODE", "ORIENTATION"))
def kinematic_coupling(card, reader):
    """The old form: lines `node or set, first, last`; nodes with equal components are one
    coupling."""
    reference = reader.node_of(card, "REF NODE")
    frame = _frame_of(card, reader)
    parts = {}
    for line, fields in card.rows():
        first = integer(fields[1], line) if len(fields) > 1 and fields[1] else 1
        default = first if len(fields) > 1 and fields[1] else 6
        last = integer(fields[2], line) if len(fields) > 2 and fields[2] else default
        if not 1 <= first <= last <= 6 or len(fields) > 3:
            raise Fault("a line has a node or set, and the first and last component", line=line)
        components = frozenset(range(first - 1, last))
        parts.setdefault(components, []).append(reader.nodes_of(fields[0], line))
    for number, (components, nodes) in enumerate(parts.items(), 1):
        name = f"coupling_{card.source.line}" + (f"_{number}" if number > 1 else "")
        one = Rigid("coupled", np.concatenate(nodes), reference, card.source, name=name)
        one.frame = frame
        _couple(one, set(components), reader)
        reader.model.rigid.append(one)


@handles("MPC")
def multi_point_constraint(card, reader):
    """Lines `type, dependent, independent` with nodes or sets, which are paired in their order."""
    reader.decide()
    if reader.dialect is not ABAQUS:
        raise Fault("multi-point constraints of CalculiX are not supported; use *EQUATION")
    beams = {}
    for line, fields in card.rows():
        if len(fields) != 3:
            raise Fault("a line has a type, the dependent node or set and the other", line=line)
        kind = fields[0].strip().upper()
        first, second = (reader.nodes_of(field, line) for field in fields[1:])
        if len(second) == 1:
            second = np.repeat(second, len(first))
        if len(first) != len(second):
            raise Fault("the two sets have different numbers of nodes", line=line)
        if kind not in ("BEAM", "PIN", "TIE", "LINK"):
            raise Fault(f"the type {kind} is not supported", kind, line)
        for one, other in zip(first.tolist(), second.tolist()):
            if kind == "BEAM":
                beams.setdefault(other, []).append(one)
            else:
                _equate(kind, one, other, card, reader, line)
    for number, (reference, nodes) in enumerate(beams.items(), 1):
        name = f"mpc_{card.source.line}" + (f"_{number}" if number > 1 else "")
        rigid = Rigid("mpc", np.array(nodes, np.int64), reference, card.source, name=name)
        reader.model.rigid.append(rigid)


def _equate(kind, one, other, card, reader, line):
    """PIN: equal displacements; TIE: also rotations, if both nodes have some; LINK: constant
    distance."""
    equations = reader.model.equations
    if kind == "LINK":
        first, second = reader.model.nodes.at([one, other])
        axis = first - second
        length = np.linalg.norm(axis)
        if length == 0:
            raise Fault("the two nodes of a link are at one place", line=line)
        terms = [(one, at, value) for at, value in enumerate(axis / length) if value]
        terms += [(node, at, -value) for node, at, value in [(other, *term[1:]) for term in terms]]
        equations.append(Equation(terms, card.source, in_global_axes=True))
        return
    rotations = kind == "TIE" and not np.any(reader.in_cells([one, other]))
    for at in range(6 if rotations else 3):
        terms = [(one, at, 1.0), (other, at, -1.0)]
        equations.append(Equation(terms, card.source, in_global_axes=True))
