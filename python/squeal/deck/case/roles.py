# SPDX-License-Identifier: BSD-2-Clause
"""What the nodes of a model are in the case: nodes of cells, reference nodes or rotations of them.

Nodes outside the cells that something refers to become reference nodes. Their components that
nothing uses have no stiffness, and the case holds them.
"""
import numpy as np

from squeal.deck.case.groups import NODES
from squeal.deck.journal import TRANSLATED, Fault, Missing
from squeal.deck.model import EMPTY


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
            self.references[number] = f"reference_{number}"
        for rigid in model.rigid:
            self._follow(rigid)

    def _span(self, number, component):
        """Returns the global components that a component in the axes of a node may have a part
        of."""
        if number not in self.model.frames:
            return {component}
        return set(range(3) if component < 3 else range(3, 6))

    def _follow(self, rigid):
        """A reference node that follows another one has its components."""
        turning = () if rigid.pinned else (3, 4, 5)
        joined = range(3) if rigid.frame is not None else rigid.components
        for number in rigid.nodes.tolist() if rigid.nodes is not None else ():
            if number != rigid.reference and number in self.references:
                table = self.used if number in self.used else self.joined
                table.setdefault(number, set()).update((*joined, *turning))

    def _rigid(self, rigid):
        others = [one for one in self.model.rigid if one.reference == rigid.reference]
        if rigid.name is None and others[0] is not rigid:
            raise Fault(f"node {rigid.reference} is the REF NODE of two rigid bodies")
        if not rigid.components:
            raise Fault("no *KINEMATIC or *DISTRIBUTING follows this card")
        if rigid.distributed and self.in_cells(rigid.reference):
            raise Fault(f"the reference node {rigid.reference} belongs to solid cells")
        name = self.references[rigid.reference] = f"reference_{rigid.reference}"
        joined = range(3) if rigid.frame is not None else rigid.components
        self.joined.setdefault(rigid.reference, {3, 4, 5}).update(joined)
        if rigid.rotation is not None:
            if rigid.rotation in self.rotations or rigid.rotation in self.references:
                raise Fault(f"node {rigid.rotation} has two roles in rigid bodies")
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
        """Uses of bushings, masses with inertia and distributed couplings, and of the loads and
        supports of nodes that follow others."""
        model = self.model
        for one in model.bushings:
            ends = [one.first] if one.second is None else [one.first, one.second]
            yield from ((node, at) for node in ends for at in one.components())
        for one in model.inertias:
            yield from ((one.node, at) for at in range(6 if one.turns else 3))
        for one in model.distributed:
            yield from ((one.reference, at) for at in range(6))
            yield from ((node, at) for node in one.nodes.tolist() for at in range(3))
        states = set(model.state.forces) | set(model.state.supports)
        touched = {number for number, _ in states}
        for rigid in model.rigid:
            for number in rigid.nodes.tolist() if rigid.nodes is not None else ():
                if number in touched and not self.in_cells(number):
                    yield from ((number, at) for at in rigid.components)

    def in_cells(self, number):
        at = np.searchsorted(self.cell_nodes, number)
        return at < len(self.cell_nodes) and self.cell_nodes[at] == number

    def is_used(self, number):
        return self.in_cells(number) or number in self.references or number in self.rotations

    def place(self, number, component):
        """Returns the name of a reference node, or None for a node of cells, and the component
        there. Raises Fault for a component without a meaning."""
        if number in self.rotations:
            if component > 2:
                raise Fault(f"node {number} has the components 1 to 3, which are rotations")
            if number in self.model.frames:
                raise Fault(f"node {number}, whose components are rotations, has a *TRANSFORM")
            return self.rotations[number], component + 3
        if number in self.references:
            return self.references[number], component
        if not self.in_cells(number):
            self.model.nodes.at([number])
            raise Missing(f"node {number} belongs to no element that is translated")
        if component > 2:
            raise Fault(f"node {number} of solid cells has no rotations")
        return None, component

    def name(self, number):
        """Returns the name by which an option refers to one node."""
        if number in self.references:
            return self.references[number]
        return self.case.group(NODES, [number], f"node_{number}")

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
