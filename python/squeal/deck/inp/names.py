# SPDX-License-Identifier: BSD-2-Clause
"""Looks up what the words of a deck refer to: nodes, elements, sets and surfaces."""
import numpy as np

from squeal.deck.inp.assembly import Scope
from squeal.deck.inp.cards import key_of
from squeal.deck.journal import TRANSLATED, Fault
from squeal.deck.mesh import EMPTY
from squeal.deck.numbers import integer, is_integer
from squeal.deck.topology import free_faces


class Names:
    """`scope`: the instance whose cards are read, or the model; `structure`: all of them."""

    def __init__(self, model, journal):
        self.model, self.journal = model, journal
        self.scope, self.structure = Scope(), None
        self._free = self._cell_nodes = None

    def defined(self, card, parameter):
        """Returns the key and the name, as it is shown, of what a card defines."""
        start = f"{self.scope.name}." if self.scope.name else ""
        return self.scope.prefix + card.key(parameter), start + card.require(parameter)

    def key_in(self, scope, key):
        """Returns the key in the model of a name in a scope."""
        return scope.prefix + key if scope.prefix else self.structure.outer(key)

    def key(self, card, parameter, table):
        """Returns the key of what a parameter refers to; within a part it may be of the model."""
        return self.set_key(card.parameters[parameter] if card.key(parameter) else "", table)

    def set_key(self, word, table):
        key = key_of(word)
        inner = self.key_in(self.scope, key)
        return key if inner not in table and key in table else inner

    def scope_of(self, card):
        """Returns the instance of INSTANCE=, or the scope that is read."""
        if "INSTANCE" not in card.parameters:
            return self.scope
        if self.scope.name:
            raise Fault("this card of a part names an instance", "INSTANCE")
        card.require("INSTANCE")
        return self.structure.instance(card.parameters["INSTANCE"])

    def number_of_instance(self, word, sets):
        """Returns the number that `instance.number` is in the model, None for any other word."""
        name, dot, number = word.rpartition(".")
        if not dot or not is_integer(number) or self.scope.name:
            return None
        try:
            scope = self.structure.instance(name)
        except Fault:
            return None
        nodes = sets is self.model.node_sets
        return (scope.node_numbers if nodes else scope.element_numbers).one(integer(number))

    def node_number(self, word, line=None):
        """Returns the number of a node, given as a number or as `instance.number`. Raises Fault."""
        number = self.number_of_instance(word, self.model.node_sets)
        if number is None:
            return self.scope.node_numbers.one(integer(word, line), line)
        return number

    def node_of(self, card, parameter):
        """Returns the node of a parameter: a number or a set of one node. Raises Fault."""
        card.require(parameter)
        numbers = self.nodes_of(card.parameters[parameter], card.source.line)
        if len(numbers) != 1:
            raise Fault(f"{parameter}= has {len(numbers)} nodes in place of one")
        self.model.nodes.at(numbers)
        return int(numbers[0])

    def nodes_of(self, word, line):
        """Returns the node, or the nodes of the set, that a field names. Raises Fault."""
        return self._members(word, line, self.model.node_sets, self.scope.node_numbers)

    def elements_of(self, word, line):
        """Returns the element, or the elements of the set, that a field names. Raises Fault."""
        return self._members(word, line, self.model.element_sets, self.scope.element_numbers)

    def label_of(self, word, sets):
        """Returns the key of the set that a field names, None for a number."""
        return None if is_integer(word) else self.set_key(word, sets)

    def surface_of(self, word, line):
        """Returns the key of a surface. Raises Fault if there is none."""
        key = self.set_key(word, self.model.surfaces)
        if key not in self.model.surfaces:
            raise Fault(f"there is no surface '{word}'", line=line)
        return key

    def _members(self, word, line, sets, own):
        if is_integer(word):
            if self.scope.prefix + word in sets:
                self.journal.choose(f"line {line}: {word} is read as a number, not as a set")
            return np.array([own.one(integer(word, line), line)], np.int64)
        key = self.set_key(word, sets)
        number = None if key in sets else self.number_of_instance(word, sets)
        if number is not None:
            return np.array([number], np.int64)
        try:
            return sets.members(key)
        except Fault as fault:
            raise Fault(fault.reason, line=line) from None

    def kinds_of(self, elements):
        """Returns the kinds of elements; elements that do not exist are left out."""
        blocks, _ = self.model.find_elements(elements)
        return {self.model.blocks[block].kind for block in np.unique(blocks[blocks >= 0])}

    def nodes_of_element_set(self, key):
        """Returns the nodes of the elements of a set, also while elements are still read."""
        members = self.model.element_sets.members(key)
        found = [
            block.nodes[np.isin(block.numbers, members)].ravel() for block in self.model.blocks
        ]
        return np.unique(np.concatenate([EMPTY, *found]))

    def in_cells(self, numbers):
        """Returns for each node whether a solid cell has it. To be called when all are read."""
        if self._cell_nodes is None:
            nodes = [block.nodes.ravel() for block in self.model.blocks if block.shape]
            self._cell_nodes = np.unique(np.concatenate([EMPTY, *nodes]))
        return np.isin(numbers, self._cell_nodes)

    def temperature(self):
        """Returns the temperature at the start, 0 by default. Raises Fault if it is not uniform."""
        self.in_cells([])
        values = np.zeros(len(self._cell_nodes))
        for nodes, value, source in self.model.temperatures:
            values[np.isin(self._cell_nodes, nodes)] = value
            self.journal.mark(source, TRANSLATED)
        if np.any(values != values[:1]):
            raise Fault("constants that depend on temperatures, which differ at the start")
        return float(values[0]) if len(values) else 0.0

    def free_faces(self, elements):
        """Returns the faces of elements at the surface of the mesh, as rows (element, face)."""
        if self._free is None:
            self._free = free_faces(self.model)
        return self._free[np.isin(self._free[:, 0], elements)]
