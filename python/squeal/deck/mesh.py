# SPDX-License-Identifier: BSD-2-Clause
"""The mesh of a model: nodes, elements, sets and surfaces."""
from dataclasses import dataclass

import numpy as np

from squeal.deck.journal import Fault, Source

EMPTY = np.zeros(0, dtype=np.int64)


class Nodes:
    """Numbers and coordinates; a number that is given again replaces the earlier coordinates.
    `label`: returns how messages name a node."""

    def __init__(self):
        self.label = str
        self._parts = []
        self._sorted = None

    def add(self, numbers, coordinates):
        self._parts.append((np.asarray(numbers, np.int64), np.asarray(coordinates, float)))
        self._sorted = None

    def add_all(self, other, placed):
        """Adds the nodes of another object, at the places that a function gives."""
        for numbers, coordinates in other._parts:
            self.add(numbers, placed(coordinates))

    @property
    def largest(self):
        """The largest number, 0 without nodes."""
        return max((int(numbers.max()) for numbers, _ in self._parts if len(numbers)), default=0)

    def _table(self):
        if self._sorted is None:
            numbers = np.concatenate([EMPTY, *(part[0] for part in self._parts)])
            places = np.concatenate([np.zeros((0, 3)), *(part[1] for part in self._parts)])
            # The last one of equal numbers counts.
            unique, first, counts = np.unique(numbers[::-1], return_index=True, return_counts=True)
            self._sorted = unique, places[::-1][first], unique[counts > 1]
        return self._sorted

    @property
    def numbers(self):
        return self._table()[0]

    @property
    def coordinates(self):
        return self._table()[1]

    @property
    def repeated(self):
        """The numbers of nodes whose coordinates were replaced."""
        return self._table()[2]

    def has(self, numbers):
        """Returns for each number whether there is a node."""
        known = self.numbers
        if not len(known):
            return np.zeros(np.shape(numbers), bool)
        at = np.minimum(np.searchsorted(known, numbers), len(known) - 1)
        return known[at] == numbers

    def at(self, numbers):
        """Returns the coordinates of nodes, one row each. Raises Fault for an unknown one."""
        numbers = np.asarray(numbers, np.int64)
        there = self.has(numbers)
        if not np.all(there):
            missing = np.atleast_1d(numbers)[~np.atleast_1d(there)][0]
            raise Fault(f"there is no node {self.label(int(missing))}")
        return self.coordinates[np.searchsorted(self.numbers, numbers)]

    def move(self, number, place):
        self.coordinates[np.searchsorted(self.numbers, number)] = place


@dataclass
class Block:
    """Elements of one kind: `kind` is the deck's word (C3D20R); `nodes` in Abaqus' order; `shape`
    is that of solid cells, otherwise None."""

    kind: str
    shape: object
    numbers: np.ndarray
    nodes: np.ndarray
    source: Source


class Sets:
    """Named sets of numbers, which may contain each other; `what` they are, for messages."""

    def __init__(self, what):
        self.what = what
        self.spelled = {}
        self.sources = {}
        self._parts = {}
        self._unsorted = set()
        self._members = {}

    def __contains__(self, key):
        return key in self._parts

    def __iter__(self):
        return iter(self._parts)

    def add(self, key, spelled, source, parts=(), unsorted=False):
        """Appends to a set numbers (arrays, or functions that return one) and names of sets
        (strings). An `unsorted` set keeps their order."""
        if unsorted:
            self._unsorted.add(key)
        self.spelled.setdefault(key, spelled)
        self.sources.setdefault(key, []).append(source)
        self._parts.setdefault(key, []).extend(parts)
        self._members.clear()

    def members(self, key):
        """Returns the numbers of a set, each once: ascending, as in Abaqus, or in the order of the
        deck if the set is unsorted. Raises Fault."""
        # Not recursive: decks may have sets of sets to any depth.
        path = {} if key in self._members else {key: self._names(key)}
        while path:
            above, names = next(reversed(path.items()))
            inner = next((name for name in names if name not in self._members), None)
            if inner in path:
                raise Fault(f"the {self.what} set '{inner}' contains itself")
            if inner is not None:
                path[inner] = self._names(inner)
                continue
            numbers = np.concatenate([EMPTY, *map(self._numbers, self._parts[above])])
            ascending, first = np.unique(numbers, return_index=True)
            self._members[above] = numbers[np.sort(first)] if above in self._unsorted else ascending
            del path[above]
        return self._members[key]

    def _names(self, key):
        """Returns an iterator over the names of sets in a set. Raises Fault."""
        if key not in self._parts:
            raise Fault(f"there is no {self.what} set '{key}'")
        return (part for part in self._parts[key] if isinstance(part, str))

    def _numbers(self, part):
        if isinstance(part, str):
            return self._members[part]
        return part() if callable(part) else part


@dataclass
class Surface:
    """Faces (element number, number of the face from 0) or, without TYPE=ELEMENT, nodes.
    `areas_differ`: the deck gives areas to the nodes, and not the same to all."""

    name: str
    source: Source
    nodes: np.ndarray = None
    elements: np.ndarray = None
    faces: np.ndarray = None
    areas_differ: bool = False

    @property
    def rows(self):
        """The faces as rows (element, face)."""
        return np.column_stack([self.elements, self.faces])


@dataclass(frozen=True)
class Instance:
    """Numbers of a part are greater in the model, by the offsets of its instance; those of its
    elements are up to `last_element`. `name` is empty for the assembly."""

    name: str
    node_offset: int
    element_offset: int
    last_element: int
