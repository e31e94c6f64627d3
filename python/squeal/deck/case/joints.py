# SPDX-License-Identifier: BSD-2-Clause
"""Equations, rigid bodies, couplings, springs, dashpots and masses of a case."""
import numpy as np

from squeal.deck.attachments import Distributed
from squeal.deck.case.attachments import add_attachments, add_distributed
from squeal.deck.case.groups import NODES, clean, text_of
from squeal.deck.case.roles import elements_in
from squeal.deck.case.weights import coupling_weights
from squeal.deck.journal import TRANSLATED, Fault, Missing

COMPONENTS = ("x", "y", "z", "rx", "ry", "rz")


def add_joints(model, roles, case, journal, faces):
    """`faces`: the object that looks faces of elements up. A fault of one joint does not keep the
    others from being translated."""
    places = Numbered(faces, journal)
    for translate, joints in (
        (_equation, model.equations),
        (_mean, model.means),
        (_rigid, model.rigid),
        (_joint, model.joints),
        (_mass, model.masses),
    ):
        for joint in joints:
            try:
                translate(joint, model, roles, case, places)
                journal.mark(joint.source, TRANSLATED)
            except Fault as fault:
                journal.refuse_fault(joint.source, fault)
    _require_masses(model, places, journal)
    turns = model.static and model.frequency and model.program != "Abaqus"
    if turns and any(one.kind == "line" for one in model.joints):
        journal.choose(
            "SPRINGA keeps its direction; CalculiX turns it with the displacements of the static"
            " step before it computes frequencies"
        )
    add_attachments(model, roles, case, journal)
    for number in roles.used:
        position = model.nodes.at([number])[0]
        case.set(("reference", roles.references[number], "position"), position)


class Numbered:
    """Names with the line of their card, and a number if a card gives several; masses by node."""

    def __init__(self, faces, journal):
        self.faces, self.journal = faces, journal
        self.counts = {}
        self.masses = {}

    def name(self, kind, source):
        stem = f"{kind}_{source.line}"
        count = self.counts[stem] = self.counts.get(stem, 0) + 1
        return stem if count == 1 else f"{stem}_{count}"


def set_equation(case, name, terms, source):
    """Sets an equation of terms (name, component, coefficient), whose sum is zero."""
    sign = -1.0 if terms[0][2] < 0 else 1.0
    text = ""
    for place, component, coefficient in terms:
        value = sign * float(coefficient)
        joint = "" if not text else (" - " if value < 0 else " + ")
        factor = "" if abs(value) == 1 else f"{abs(value)!r}*"
        text += f"{joint}{factor}{place}:{COMPONENTS[component]}"
    case.set(("equation", name), f"{text} = 0", source)


def _equation(equation, model, roles, case, places):
    terms = roles.global_terms(equation.terms, not equation.in_global_axes)
    name = equation.name or places.name("line", equation.source)
    set_equation(case, name, terms, equation.source)


def _mean(mean, model, roles, case, places):
    """u_R = Σ w u / Σ w for each component."""
    weights = mean.weights / mean.weights.sum()
    for component in range(3):
        terms = [(roles.name(mean.reference), component, 1.0)]
        for number, weight in zip(mean.nodes.tolist(), weights):
            roles.place(number, component)
            terms.append((roles.name(number), component, -weight))
        set_equation(case, places.name("line", mean.source), terms, mean.source)


def _rigid(rigid, model, roles, case, places):
    if not rigid.components or rigid.reference not in roles.references:
        return  # refused with its role
    numbers, wanted = _coupled_nodes(rigid, model, places.faces)
    if roles.in_cells(rigid.reference) and not _follows_itself(rigid.reference, model):
        numbers = [*numbers, rigid.reference]  # the node of the cells is the reference node
    name = roles.references[rigid.reference]
    inside = [number for number in numbers if roles.in_cells(number)]
    others = [
        roles.references[number]
        for number in numbers
        if number in roles.references and number != rigid.reference and not roles.in_cells(number)
    ]
    if not inside and not others:
        raise Missing("none of its nodes belongs to an element that is translated")
    case.set(("reference", name, "position"), model.nodes.at([rigid.reference])[0], rigid.source)
    if rigid.weighting is not None:
        numbers, weights = coupling_weights(rigid, numbers, model, places.faces, places.journal)
        one = Distributed(rigid.name, rigid.reference, numbers, weights, rigid.source, wanted)
        add_distributed(one, model, roles, case)
        return
    nodes = [case.group(NODES, inside, wanted)] if inside else []
    path = ("coupling", clean(rigid.name) if rigid.name else name)
    case.set((*path, "reference"), name, rigid.source)
    case.set((*path, "nodes"), ",".join(nodes + others), rigid.source)
    if others and rigid.mixed:
        raise Fault("some, but not all, rotations of reference nodes are not supported")
    if others and rigid.pinned:
        case.set((*path, "pinned"), True, rigid.source)
    if len(rigid.components) < 3:
        letters = "".join("xyz"[component] for component in rigid.components)
        case.set((*path, "components"), letters, rigid.source)
    if rigid.pinned and others:
        case.set((*path, "pinned"), True, rigid.source)
    if rigid.frame is not None and len(rigid.components) < 3:
        case.set((*path, "frame"), case.frame(rigid.frame), rigid.source)


def _follows_itself(number, model):
    """Returns whether the node of the cells is in a rigid body with itself as reference node."""
    return any(
        one.reference == number and one.nodes is not None and number in one.nodes
        for one in model.rigid
    )


def _coupled_nodes(rigid, model, faces):
    """Returns the nodes of a rigid body or of a coupling, and a name for their group."""
    if rigid.surface is None:
        sets = model.node_sets if rigid.label in model.node_sets else model.element_sets
        return rigid.nodes.tolist(), sets.spelled.get(rigid.label, rigid.label)
    surface = model.surfaces[rigid.surface]
    nodes = faces.nodes_of(surface)
    if surface.nodes is None and not len(nodes):
        raise Fault(f"the surface '{surface.name}' has no faces")
    return _within(nodes, rigid, model), surface.name


def _within(nodes, rigid, model):
    """Returns the nodes in the radius of influence of a coupling."""
    if rigid.radius is not None:
        away = model.nodes.at(nodes) - model.nodes.at([rigid.reference])
        nodes = nodes[np.linalg.norm(away, axis=1) <= rigid.radius]
    return nodes.tolist()


def _joint(joint, model, roles, case, places):
    for number, nodes in elements_in(model, joint.label):
        if joint.kind != "line":
            _of_components(joint, number, nodes, roles, case)
            continue
        for node in nodes:
            roles.place(node, 0)
        path = ("spring", _element(number, model))
        case.set((*path, "from"), roles.name(nodes[0]), joint.source)
        case.set((*path, "to"), roles.name(nodes[1]), joint.source)
        for key, value in (("stiffness", joint.stiffness), ("damping", joint.damping)):
            if value:
                case.set((*path, key), value, joint.source)


def _element(number, model):
    return f"element_{clean(model.element_name(number))}"


def _of_components(joint, number, nodes, roles, case):
    """A spring of one component, or between two: as a bushing to the ground if that component is
    global, otherwise by a reference node whose displacement x is the elongation."""
    terms = [(node, at, sign) for node, at, sign in zip(nodes, joint.components, (1.0, -1.0))]
    found = roles.global_terms(terms)
    element = _element(number, roles.model)
    if len(found) == 1:
        ((name, component, _),) = found
    else:
        name, component = f"reference_{element}", 0
        equation = [(name, 0, 1.0), *((place, at, -value) for place, at, value in found)]
        set_equation(case, element, equation, joint.source)
        position = roles.model.nodes.at([nodes[0]])[0]
        case.set(("reference", name, "position"), position, joint.source)
        case.set(("constraint", name, "clamped"), "yz", joint.source)
        case.set(("constraint", name, "clamped_rotation"), "xyz", joint.source)
    path = ("bushing", element)
    case.set((*path, "from"), name, joint.source)
    for key, value in (("stiffness", joint.stiffness), ("damping", joint.damping)):
        if value:
            values = np.zeros(3 if component < 3 else 6)
            values[component] = value
            case.set((*path, key), values, joint.source)


def _mass(mass, model, roles, case, places):
    for number, nodes in elements_in(model, mass.label):
        at = nodes[0]
        roles.place(at, 0)
        total, inertia = places.masses.get(at, (0.0, np.zeros((3, 3))))
        if mass.inertia is not None:
            roles.place(at, 3)
            inertia = inertia + mass.inertia
        places.masses[at] = total + mass.mass, inertia
        options = case.options.setdefault("mass", {}).setdefault(roles.name(at), {})
        options["total"] = (text_of(places.masses[at][0]), mass.source)
        if np.any(inertia):
            order = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
            options["inertia"] = (text_of([inertia[pair] for pair in order]), mass.source)


def _require_masses(model, places, journal):
    """A rotary inertia needs a mass, since the program has no other."""
    for mass in model.masses:
        if mass.inertia is None:
            continue
        for _, nodes in elements_in(model, mass.label):
            if places.masses.get(nodes[0], (1.0, None))[0] == 0:
                journal.refuse(mass.source, f"node {model.node_label(nodes[0])} has no *MASS")
