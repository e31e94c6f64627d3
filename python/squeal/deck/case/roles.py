# SPDX-License-Identifier: BSD-2-Clause
"""What the nodes of a model are in the case: nodes of cells, reference nodes or rotations of them.

Nodes outside the cells that something refers to become reference nodes. Their components that
nothing uses have no stiffness, and the case holds them.
"""
import numpy as np

from squeal.deck.case.groups import NODES, clean
from squeal.deck.journal import TRANSLATED, Fault, Missing
from squeal.deck.mesh import EMPTY


class Roles:
    """`used`: components of loose nodes that equations, springs or masses use; `joined`: those of
    the reference nodes of rigid bodies and couplings."""

    def __init__(self, model, case, journal):
        self.model, self.case, self.journal = model, case, journal
        cells = [block.nodes.ravel() for block in model.blocks if block.shape]
        self.cell_nodes = np.unique(np.concatenate([EMPTY, *cells]))
        self.references = {}  # node -> name of its reference node
        self.rotations = {}  # node whose components are rotations -> name of that reference node
        self.used, self.joined = {}, {}
        for rigid in model.rigid:
            try:
                self._rigid(rigid)
            except Fault as fault:
                journal.refuse_fault(rigid.source, fault)
        for number, component in self._uses():
            if number in self.joined:
                self.joined[number].update(self._span(number, component))
            if self.is_used(number) and number not in self.used or not model.nodes.has(number):
                continue
            self.used.setdefault(number, set()).update(self._span(number, component))
            self.references[number] = self._reference(number)
        for rigid in model.rigid:
            self._join_loose(rigid)

    def _span(self, number, component):
        """Returns the global components that a component in the axes of a node may have a part
        of."""
        if number not in self.model.frames:
            return {component}
        return set(range(3) if component < 3 else range(3, 6))

    def _reference(self, number):
        return f"reference_{clean(self.model.node_name(number))}"

    def _join_loose(self, rigid):
        """Loose nodes that a coupling moves: those that something else refers to become reference
        nodes, which need no support."""
        nodes = rigid.nodes if rigid.surface is None else self.model.surfaces[rigid.surface].nodes
        if nodes is None or not rigid.components or rigid.weighting:
            return
        state = self.model.state
        referred = {number for table in (state.forces, state.supports) for number, _ in table}
        referred -= {*self.references, *self.rotations}
        loose = np.setdiff1d(nodes, self.cell_nodes)
        for number in loose[self.model.nodes.has(loose)].tolist():
            if number in referred:
                self.references[number] = self._reference(number)
                self.used[number] = set()
            table = self.used if number in self.used else self.joined
            if number in table and number != rigid.reference:
                turned = rigid.frame is not None
                table[number].update(range(3) if turned else rigid.components)
                table[number].update(() if rigid.pinned else (3, 4, 5))

    def _rigid(self, rigid):
        label = self.model.node_label
        others = [one for one in self.model.rigid if one.reference == rigid.reference]
        if rigid.name is None and others[0] is not rigid:
            raise Fault(f"node {label(rigid.reference)} is the REF NODE of two rigid bodies")
        if not rigid.components:
            raise Fault("no *KINEMATIC or *DISTRIBUTING follows this card")
        if rigid.weighting and self.in_cells(rigid.reference):
            raise Fault(f"the reference node {label(rigid.reference)} belongs to solid cells")
        name = self.references[rigid.reference] = self._reference(rigid.reference)
        joined = range(3) if rigid.frame is not None else rigid.components
        self.joined.setdefault(rigid.reference, {3, 4, 5}).update(joined)
        if rigid.rotation is not None:
            if rigid.rotation in self.rotations or rigid.rotation in self.references:
                raise Fault(f"node {label(rigid.rotation)} has two roles in rigid bodies")
            self.rotations[rigid.rotation] = name

    def _uses(self):
        """Yields node and component of what may give a loose node a stiffness or a mass."""
        model = self.model
        for equation in model.equations:
            yield from ((node, component) for node, component, _ in equation.terms)
        for mean in model.means:
            numbers = [mean.reference, *mean.nodes.tolist()]
            yield from ((number, component) for number in numbers for component in range(3))
        for joint in model.joints:
            for _, nodes in elements_in(model, joint.label):
                for node, component in zip(nodes, joint.components):
                    yield node, component
                if joint.kind == "line":
                    yield from ((node, component) for node in nodes for component in range(3))
        for mass in model.masses:
            for _, nodes in elements_in(model, mass.label):
                components = range(3) if mass.inertia is None else range(6)
                yield from ((node, component) for node in nodes for component in components)
        yield from self._attached()

    def _attached(self):
        """Uses of bushings, masses with inertia and distributed couplings."""
        model = self.model
        for one in model.bushings:
            ends = [one.first] if one.second is None else [one.first, one.second]
            yield from ((node, at) for node in ends for at in one.components())
        for one in model.inertias:
            yield from ((one.node, at) for at in range(6 if one.turns else 3))
        for one in model.distributed:
            yield from ((one.reference, at) for at in range(6))
            yield from ((node, at) for node in one.nodes.tolist() for at in range(3))

    def in_cells(self, number):
        at = np.searchsorted(self.cell_nodes, number)
        return at < len(self.cell_nodes) and self.cell_nodes[at] == number

    def is_used(self, number):
        return self.in_cells(number) or number in self.references or number in self.rotations

    def place(self, number, component):
        """Returns the name of a reference node, or None for a node of cells, and the component
        there. Raises Fault for a component without a meaning."""
        label = self.model.node_label
        if number in self.rotations:
            if component > 2:
                raise Fault(f"node {label(number)} has the components 1 to 3, which are rotations")
            if number in self.model.frames:
                raise Fault(
                    f"node {label(number)}, whose components are rotations, has a *TRANSFORM"
                )
            return self.rotations[number], component + 3
        if number in self.references:
            return self.references[number], component
        if not self.in_cells(number):
            self.model.nodes.at([number])
            raise Missing(f"node {label(number)} belongs to no element that is translated")
        if component > 2:
            raise Fault(f"node {label(number)} of solid cells has no rotations")
        return None, component

    def name(self, number):
        """Returns the name by which an option refers to one node."""
        if number in self.references:
            return self.references[number]
        return self.case.group(NODES, [number], f"node_{self.model.node_name(number)}")

    def global_terms(self, terms, own_axes=True):
        """Returns terms (name, component, coefficient) in global axes of terms of nodes in their
        own axes, or in global ones, with equal places added up. Raises Fault."""
        found = {}
        for number, component, coefficient in terms:
            reference, at = self.place(number, component)
            frame = self.model.frames.get(number) if own_axes else None
            if at > 2 or frame is None:
                parts = {at: coefficient}
            else:
                self.journal.mark(frame.source, TRANSLATED)
                axis = frame.axes_at(self.model.nodes.at([number])[0])[at]
                parts = {one: coefficient * axis[one] for one in range(3)}
            for one, value in parts.items():
                place = reference or self.name(number), one
                found[place] = found.get(place, 0.0) + value
        largest = max((abs(value) for value in found.values()), default=0.0)
        if largest == 0:
            raise Fault("all coefficients of an equation are zero")
        return [(*place, value) for place, value in found.items() if abs(value) > 1e-14 * largest]


def elements_in(model, label):
    """Yields number and nodes of the elements of a set."""
    members = model.element_sets.members(label)
    blocks, rows = model.find_elements(members)
    for number, block, row in zip(members.tolist(), blocks, rows):
        if block >= 0:
            yield number, model.blocks[block].nodes[row].tolist()
