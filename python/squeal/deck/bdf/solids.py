# SPDX-License-Identifier: BSD-2-Clause
"""Solid elements: CHEXA, CPENTA, CPYRAM and CTETRA with nodes in the middle of all, some or no
edges.

An edge without its node is straight, and displacements are linear along it. An element that has
nodes on some edges only is one with all of them, in which the missing ones are the mean of the ends
of their edge: the shape functions that Nastran uses (a serendipity element with nodes removed).
"""
import numpy as np

from squeal.deck.bdf.cards import Card
from squeal.deck.bdf.columns import integers, table_of
from squeal.deck.cells import HEX8, HEX20, PYRAMID5, PYRAMID13, TET4, TET10, WEDGE6, WEDGE15
from squeal.deck.journal import USED, Fault
from squeal.deck.mesh import Block
from squeal.deck.model import Equation

# Shapes without and with nodes on edges, and the place in Nastran's order of each of our nodes.
KINDS = {
    "CHEXA": (HEX8, HEX20, (*range(12), *range(16, 20), *range(12, 16))),
    "CPENTA": (WEDGE6, WEDGE15, (*range(9), *range(12, 15), *range(9, 12))),
    "CPYRAM": (PYRAMID5, PYRAMID13, tuple(range(13))),
    "CTETRA": (TET4, TET10, tuple(range(10))),
}


class Solids:
    """Elements of all kinds: `properties` are rows (element, property)."""

    def __init__(self, deck, journal):
        self.deck, self.journal = deck, journal
        self.tables = {}  # name -> rows of element, property and nodes in our order, 0: none
        self.sources = {}
        for name, (_, shape, order) in KINDS.items():
            parts = []
            for block in deck.tables(name):
                parts.append(self._chunk(name, shape, *block))
            if parts:
                table = np.concatenate(parts)
                self.tables[name] = table[:, (0, 1, *(at + 2 for at in order))]
                self.sources[name] = deck.sources[name][0][1]
            for _, source in deck.sources.get(name, ()):
                journal.mark(source, USED)

    def _chunk(self, name, shape, texts, first, count):
        width = shape.size + 2
        try:
            if texts is None:
                texts = table_of(list(self.deck.rows(name, first, count)), width)
            elif np.any(texts[:, width:] != b""):
                raise ValueError
            table = np.zeros((len(texts), width), np.int64)
            for at, column in enumerate(texts[:, :width].T):
                table[:, at] = integers(column)
            corners = KINDS[name][0].size
            table[:, 1] = np.where(table[:, 1] == 0, table[:, 0], table[:, 1])
            if np.any(table < 0) or np.any(table[:, : corners + 2] < 1):
                raise ValueError
            return table
        except (ValueError, OverflowError):
            chunk = self.deck.rows(name, first, count)
            rows = [self._row(name, width, *one) for one in chunk]
            rows = [row for row in rows if row is not None]
            return np.array(rows, np.int64).reshape(-1, width)

    def _row(self, name, width, fields, line, source):
        card = Card(name, source, line, fields)
        try:
            number = card.identifier(1)
            row = [number, card.identifier(2, number)]
            for at in range(3, width + 1):
                corner = at < 3 + KINDS[name][0].size
                value = card.integer(at) if corner else card.integer(at, 0)
                if value < corner:
                    raise Fault(f"field {card.place(at)}: {value} is not a grid", line=line)
                row.append(value)
            card.unread()
            return row
        except Fault as fault:
            self.journal.incomplete |= self.journal.refuse(
                source, fault.reason, fault.name, fault.line or line
            )
            return None

    def fill(self, model, properties):
        """Adds the elements to a model. `properties`: for each property the ending of the kind of
        its elements, by the shape; blocks of one kind have one quadrature."""
        for name, table in self.tables.items():
            linear, quadratic, _ = KINDS[name]
            middle = table[:, 2 + linear.size :] > 0
            full = np.any(middle, axis=1)
            partial = np.flatnonzero(full & ~np.all(middle, axis=1))
            if len(partial):
                self._complete(model, table, quadratic, partial, self.sources[name])
            for shape, on in ((linear, ~full), (quadratic, full)):
                self._blocks(model, name, shape, table[on][:, : shape.size + 2], properties)

    def _blocks(self, model, name, shape, table, properties):
        for number in np.unique(table[:, 1]).tolist():
            rows = table[table[:, 1] == number]
            kind = f"{name}{shape.size}{properties(number, shape)}"
            nodes = rows[:, 2:]
            model.blocks.append(Block(kind, shape, rows[:, 0], nodes, self.sources[name]))

    def _complete(self, model, table, shape, partial, source):
        """Gives the edges without a node one, which is the mean of the ends. Elements that share
        an edge share it."""
        following = 1 + max(int(model.nodes.numbers.max(initial=0)), int(table[:, 2:].max()))
        first, made = following, {}
        for row in partial:
            for at, ends in enumerate(shape.edges, shape.first_middle):
                if table[row, 2 + at] > 0:
                    continue
                key = frozenset(int(table[row, 2 + end]) for end in ends)
                if key not in made:
                    made[key] = following
                    following += 1
                table[row, 2 + at] = made[key]
        places = []
        for key, number in made.items():
            ends = sorted(key)
            if not np.all(model.nodes.has(np.array(ends))):
                places.append(np.zeros(3))  # refused with the mesh
                continue
            places.append(model.nodes.at(ends).mean(axis=0))
            for component in range(3):
                terms = [(number, component, 1.0)]
                terms += [(end, component, -1.0 / len(ends)) for end in ends]
                name = f"edge_{number}_{'xyz'[component]}"
                model.equations.append(Equation(terms, source, True, name))
        model.nodes.add(list(made.values()), np.array(places))
        self.journal.choose(
            f"{source}: {len(partial)} elements lack some nodes in the middle of their edges; nodes"
            f" {first} to {following - 1} are the means of the ends"
        )
