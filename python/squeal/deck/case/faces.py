# SPDX-License-Identifier: BSD-2-Clause
"""Faces of solid elements by number of element and face."""
import numpy as np

from squeal.deck.journal import Fault, Missing


class Faces:
    """Looks faces up; the elements of a model do not change meanwhile."""

    def __init__(self, model):
        self.model = model
        self.known = {}

    def require(self, element, face):
        self.nodes(element, face)

    def nodes(self, element, face):
        """Returns the nodes of a face, corners first. Raises Fault."""
        if element not in self.known:
            (block,), (row,) = self.model.find_elements(np.array([element]))
            if block < 0 or self.model.blocks[block].shape is None:
                raise Missing(f"element {element} is not a solid element")
            block = self.model.blocks[block]
            self.known[element] = block.shape, block.nodes[row]
        shape, nodes = self.known[element]
        if not 0 <= face < len(shape.faces):
            raise Fault(f"element {element} has {len(shape.faces)} faces")
        return nodes[list(shape.faces[face])]
