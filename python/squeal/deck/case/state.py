# SPDX-License-Identifier: BSD-2-Clause
"""Supports and loads of nodes and faces.

They are known node by node, and become groups of nodes that have the same values. A group gets the
name of the set that the deck has used.
"""
from squeal.deck.case.groups import FACES, NODES
from squeal.deck.journal import Fault

AXES = "xyz"


class Places:
    """Values by node and component, sorted into groups of nodes and reference nodes."""

    def __init__(self, roles, case, journal, frames):
        """`frames`: axes of nodes in which the values are given."""
        self.roles, self.case, self.journal, self.frames = roles, case, journal, frames
        self.nodes = {}  # node of cells -> {component: Value}
        self.references = {}  # name -> ({component: Value}, frame)

    def add(self, table, unused):
        """Adds a table by (node, component); `unused`(fault, value) is called for values that have
        no place, once for each card with values, and for each with zeros."""
        named = set()
        for (number, component), value in table.items():
            try:
                name, at = self.roles.place(number, component)
            except Fault as fault:
                kind = value.source, value.value == 0
                if kind not in named:
                    unused(fault, value)
                named.add(kind)
                continue
            if name is None:
                self.nodes.setdefault(number, {})[at] = value
            else:
                values, _ = self.references.setdefault(name, ({}, self.frame(number)))
                values[at] = value

    def frame(self, number):
        """Returns the name of the axes of a node, which become a frame of the case, or None."""
        frame = self.frames.get(number)
        if frame is None:
            return None
        self.journal.mark(frame.source, "translated")
        return self.case.frame(frame)

    def groups(self, default):
        """Yields name, number of nodes, frame and {component: Value} of groups of nodes with equal
        values."""
        buckets = {}
        for number, values in self.nodes.items():
            amounts = tuple(sorted((at, value.value) for at, value in values.items()))
            labels = frozenset(value.label for value in values.values())
            buckets.setdefault((self.frame(number), amounts, labels), []).append(number)
        for (frame, amounts, labels), numbers in buckets.items():
            values = self.nodes[numbers[0]]
            wanted = f"{default}_{''.join(AXES[at] for at, _ in amounts)}"
            if len(labels) == 1 and None not in labels:
                wanted = self.roles.model.node_sets.spelled.get(next(iter(labels)), wanted)
            elif len(numbers) == 1:
                wanted = f"node_{self.roles.model.node_name(numbers[0])}"
            yield self.case.group(NODES, numbers, wanted), len(numbers), frame, values


def add_supports(model, roles, case, journal):
    places = Places(roles, case, journal, model.frames)

    def unused(fault, value):
        if value.value == 0:
            journal.remark(value.source, f"{fault.reason}: not held")
        else:
            journal.refuse_fault(value.source, fault)

    places.add(model.state.supports, unused)
    for name, _, frame, values in places.groups("held"):
        _hold(case, name, frame, values, ("clamped", "displacement"), range(3))
    loose = {}
    for number, used in (*roles.used.items(), *roles.joined.items()):
        loose[roles.references[number]] = used
        places.references.setdefault(roles.references[number], ({}, places.frame(number)))
    for name, (values, frame) in places.references.items():
        free = [at for at in range(6) if at not in values and at not in loose[name]]
        held = {**values, **dict.fromkeys(free)}
        _hold(case, name, frame, held, ("clamped", "displacement"), range(3))
        _hold(case, name, frame, held, ("clamped_rotation", "angle"), range(3, 6))
        if free:
            journal.choose(
                f"{name}: nothing joins the components"
                f" {', '.join(str(at + 1) for at in free)}; they are held"
            )


def _hold(case, name, frame, values, keys, components):
    """`values` has None for a component that is held without a card."""
    chosen = {at - components[0]: values[at] for at in components if at in values}
    if not chosen:
        return
    source = next((value.source for value in chosen.values() if value), None)
    case.set(("constraint", name, keys[0]), "".join(AXES[at] for at in sorted(chosen)), source)
    amounts = [chosen[at].value if chosen.get(at) else 0.0 for at in range(3)]
    if any(amounts):
        case.set(("constraint", name, keys[1]), amounts, source)
    if frame:
        case.set(("constraint", name, "frame"), frame, source)


def add_forces(model, roles, case, journal):
    places = Places(roles, case, journal, {} if model.state.global_forces else model.frames)

    def unused(fault, value):
        if value.value != 0:
            journal.refuse_fault(value.source, fault)

    places.add(model.state.forces, unused)
    for name, count, frame, values in places.groups("loaded"):
        _load(case, name, frame, values, "force", range(3), count)
    for name, (values, frame) in places.references.items():
        _load(case, name, frame, values, "force", range(3), 1)
        _load(case, name, frame, values, "moment", range(3, 6), 1)


def _load(case, name, frame, values, key, components, count):
    """The force of a group is the total of its nodes."""
    amounts = [values[at].value if at in values else 0.0 for at in components]
    if not any(amounts):
        return
    source = next(values[at].source for at in components if at in values)
    case.set(("load", name, key), [count * amount for amount in amounts], source)
    if frame:
        case.set(("load", name, "frame"), frame, source)


def add_pressures(model, case, journal, faces):
    """`faces`: the object that looks faces of elements up."""
    buckets = {}
    for (element, face), value in model.state.pressures.items():
        buckets.setdefault((value.value, value.label, value.source), []).append((element, face))
    for (amount, label, source), rows in buckets.items():
        try:
            faces.require_outer(rows)
        except Fault as fault:
            journal.refuse_fault(source, fault)
            continue
        name = model.element_sets.spelled.get(label, (label or "pressed").lower())
        if label in model.surfaces:
            name = model.surfaces[label].name
        group = case.group(FACES, rows, name)
        case.set(("load", group, "pressure"), amount, source)
