# SPDX-License-Identifier: BSD-2-Clause
"""Coordinate systems: CORD1R, CORD1C, CORD1S, CORD2R, CORD2C and CORD2S.

A system is defined by three points: its origin, a point of its z axis, and one in its half plane of
x and z. Those of CORD2 have coordinates in another system, those of CORD1 are grids.
"""
from dataclasses import dataclass

import numpy as np

from squeal.deck.axes import Frame
from squeal.deck.journal import USED, Fault, Source

KINDS = {"R": "rectangular", "C": "cylindrical", "S": "spherical"}
# Distance from the axis over that from the origin: points without a radial direction, and those
# where the program finds none.
ON_AXIS, NEAR_AXIS = 1e-12, 1e-6


@dataclass
class System:
    """`axes`: directions of x, y, z as rows."""

    number: int
    kind: str
    origin: np.ndarray
    axes: np.ndarray
    source: Source

    def places(self, coordinates):
        """Returns the points with coordinates, one row each; angles are in degrees."""
        one, two, three = np.asarray(coordinates, float).T
        if self.kind == "cylindrical":
            angle = np.radians(two)
            local = one * np.cos(angle), one * np.sin(angle), three
        elif self.kind == "spherical":
            polar, azimuth = np.radians(two), np.radians(three)
            across = one * np.sin(polar)
            local = across * np.cos(azimuth), across * np.sin(azimuth), one * np.cos(polar)
        else:
            local = one, two, three
        return self.origin + np.column_stack(local) @ self.axes

    def axes_at(self, place):
        """Returns the directions of the components at a point as rows: on the axis of a cylindrical
        system those that define it. Raises Fault on the axis of a spherical one."""
        if self.kind == "rectangular":
            return self.axes
        local = self.axes @ (np.asarray(place) - self.origin)
        across, length = np.hypot(local[0], local[1]), np.linalg.norm(local)
        if across <= ON_AXIS * length:
            if self.kind == "spherical":
                raise Fault(f"a point on the axis of system {self.number} has no directions")
            return self.axes
        cosine, sine = local[0] / across, local[1] / across
        if self.kind == "cylindrical":
            turn = [[cosine, sine, 0], [-sine, cosine, 0], [0, 0, 1]]
        else:
            radial, down = across / length, local[2] / length
            turn = [
                [radial * cosine, radial * sine, down],
                [down * cosine, down * sine, -radial],
                [-sine, cosine, 0],
            ]
        return np.array(turn) @ self.axes

    def frame(self):
        """Returns the axes of a model that are those of the system at all points, or those that
        define a spherical one."""
        name = f"cord_{self.number}"
        if self.kind == "cylindrical":
            return Frame(name, True, self.origin, self.origin + self.axes[2], self.source)
        return self.fixed(name, self.axes)

    def fixed(self, name, axes):
        return Frame(name, False, axes[0], axes[1], self.source)

    def frames(self, places):
        """Returns the axes of the components of nodes, a frame for each. Raises Fault."""
        if self.kind == "rectangular":
            return [self.frame()] * len(places)
        if self.kind == "spherical":
            return [
                self.fixed(f"cord_{self.number}_{at}", self.axes_at(place))
                for at, place in enumerate(places, 1)
            ]
        local = (places - self.origin) @ self.axes.T
        turning = np.hypot(local[:, 0], local[:, 1]) > NEAR_AXIS * np.linalg.norm(local, axis=1)
        frame, axis = self.frame(), self.fixed(f"cord_{self.number}_axis", self.axes)
        return [frame if turns else axis for turns in turning.tolist()]


BASIC = System(0, "rectangular", np.zeros(3), np.eye(3), None)


class Systems:
    """Definitions by number, which are solved when they are needed. `grids`: returns the number of
    the system and the coordinates of a grid."""

    def __init__(self, journal, grids):
        self.journal, self.grids = journal, grids
        self.definitions = {}  # number -> (kind, system of reference or None, points, source)
        self.solved = {0: BASIC}

    def read(self, deck):
        for letter, kind in KINDS.items():
            for form in ("1", "2"):
                for card in deck.each(f"CORD{form}{letter}"):
                    try:
                        (self._grids if form == "1" else self._points)(card, kind)
                        card.unread()
                        self.journal.mark(card.source, USED)
                    except Fault as fault:
                        self.journal.refuse(card.source, fault.reason, fault.name, card.line)

    def _points(self, card, kind):
        reference = card.integer(2, 0)
        points = np.array(card.reals(3, 9, 0.0)).reshape(3, 3)
        self._define(card, card.identifier(1), kind, reference, points)

    def _grids(self, card, kind):
        for first in (1, 5):
            if first == 1 or card.word(first):
                grids = [card.identifier(first + at) for at in (1, 2, 3)]
                self._define(card, card.identifier(first), kind, None, grids)

    def _define(self, card, number, kind, reference, points):
        if number in self.definitions:
            raise Fault(f"system {number} is defined twice")
        self.definitions[number] = kind, reference, points, card.source

    def at(self, number, above=()):
        """Returns a system. Raises Fault."""
        if number in self.solved:
            return self.solved[number]
        if number not in self.definitions:
            raise Fault(f"there is no coordinate system {number}")
        if number in above:
            raise Fault(f"coordinate system {number} depends on itself")
        kind, reference, points, source = self.definitions[number]
        above = (*above, number)
        if reference is None:
            places = np.array([self._place(grid, above) for grid in points])
        else:
            places = self.at(reference, above).places(points)
        origin, up, side = places[0], places[1] - places[0], places[2] - places[0]
        normal = np.cross(up, side)
        size = np.linalg.norm(up) * np.linalg.norm(side)
        if not np.linalg.norm(normal) > 1e-10 * size:
            raise Fault(f"the three points of coordinate system {number} lie on a line")
        z, y = up / np.linalg.norm(up), normal / np.linalg.norm(normal)
        axes = np.array([np.cross(y, z), y, z])
        self.solved[number] = System(number, kind, origin, axes, source)
        return self.solved[number]

    def _place(self, grid, above):
        system, coordinates = self.grids(grid)
        return self.at(system, above).places([coordinates])[0]

    def vector(self, number, components, place=None):
        """Returns a vector in global axes; curvilinear components belong to a point. Raises
        Fault."""
        system = self.at(number)
        if system.kind != "rectangular" and place is None:
            raise Fault(f"components in the curvilinear system {number} are not supported")
        axes = system.axes if place is None else system.axes_at(place)
        return np.asarray(components, float) @ axes
