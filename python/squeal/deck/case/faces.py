# SPDX-License-Identifier: BSD-2-Clause
"""Faces of solid elements by number of element and face."""
import numpy as np

from squeal.deck.case.projection import Surface
from squeal.deck.journal import Fault, Missing
from squeal.deck.mesh import EMPTY
from squeal.deck.topology import corners_of, hashes


class Faces:
    """Looks faces up in a model."""

    def __init__(self, model):
        self.model = model

    def tables(self, rows):
        """Returns the nodes of faces, given as rows (element, face from 0): a list of (places among
        the rows, table with a row of nodes, corners first, for each place), one for each size of
        face and type of element. Raises Fault."""
        rows = np.asarray(rows, np.int64).reshape(-1, 2)
        blocks, at = self.model.find_elements(rows[:, 0])
        found = []
        for number in np.unique(blocks):
            on = np.flatnonzero(blocks == number)
            block = self.model.blocks[number] if number >= 0 else None
            if block is None or block.shape is None:
                raise Missing(f"element {self._element(rows[on[0]])} is not a solid element")
            wrong = on[(rows[on, 1] < 0) | (rows[on, 1] >= len(block.shape.faces))]
            if len(wrong):
                raise Fault(
                    f"element {self._element(rows[wrong[0]])} has {len(block.shape.faces)} faces"
                )
            for face, nodes in enumerate(block.shape.faces):
                chosen = on[rows[on, 1] == face]
                if len(chosen):
                    found.append((chosen, block.nodes[at[chosen]][:, nodes]))
        return found

    def nodes(self, rows):
        """Returns the nodes of faces in the order of the rows, one array each. Raises Fault."""
        found = [None] * len(rows)
        for places, table in self.tables(rows):
            for place, nodes in zip(places.tolist(), table):
                found[place] = nodes
        return found

    def surface(self, rows):
        """Returns the surface of faces for assigning points. Raises Fault."""
        return Surface(
            [(places, self.model.nodes.at(table)) for places, table in self.tables(rows)]
        )

    def nodes_of(self, surface):
        """Returns the nodes of a surface of nodes or of faces, in ascending order for faces. Raises
        Fault."""
        if surface.nodes is not None:
            return surface.nodes
        tables = [table.ravel() for _, table in self.tables(surface.rows)]
        return np.unique(np.concatenate([EMPTY, *tables]))

    def require_outer(self, rows):
        """Raises Fault if a face lies between two cells."""
        wanted, known = {}, [np.zeros(0, np.uint64)]
        for places, table in self.tables(rows):
            corners = np.sort(table[:, : corners_of(table.shape[1])], axis=1)
            known.append(hashes(corners))
            for place, key in zip(places.tolist(), map(tuple, corners.tolist())):
                if key in wanted:
                    raise Fault(self._inside(rows[place]))
                wanted[key] = place
        known = np.unique(np.concatenate(known))
        if not len(known):
            return
        for block in self.model.blocks:
            for number, face in enumerate(block.shape.faces if block.shape else ()):
                corners = block.nodes[:, face[: corners_of(len(face))]]
                found = hashes(corners)
                places = np.minimum(np.searchsorted(known, found), len(known) - 1)
                near = np.flatnonzero(known[places] == found)
                for at, key in zip(near.tolist(), map(tuple, np.sort(corners[near]).tolist())):
                    if key in wanted and rows[wanted[key]] != (block.numbers[at], number):
                        raise Fault(self._inside(rows[wanted[key]]))

    def _inside(self, row):
        return f"face {row[1] + 1} of element {self._element(row)} lies between two elements"

    def _element(self, row):
        return self.model.element_label(int(row[0]))
