# SPDX-License-Identifier: BSD-2-Clause
"""Local axes of a model."""
from dataclasses import dataclass

import numpy as np

from squeal.deck.journal import Fault, Source


@dataclass
class Frame:
    """Axes: rectangular with directions a, b (axis 1 along a, b in the plane 1-2), or cylindrical
    about the line from point a to point b. `turn`: axis from 0 and angle in degrees by which the
    local axes are then turned about one of them."""

    name: str
    cylindrical: bool
    a: np.ndarray
    b: np.ndarray
    source: Source
    turn: tuple = None

    def axes_at(self, place):
        """Returns the local axes at a point as rows. Raises Fault."""
        axes = self._axes_at(place)
        if self.turn is None:
            return axes
        about, degrees = self.turn
        return axes @ rotation_about(axes[about], degrees).T

    def _axes_at(self, place):
        if not self.cylindrical:
            return orthonormal(self.a, self.b)
        axis = self.b - self.a
        length = np.linalg.norm(axis)
        if length == 0:
            raise Fault("the two points of the axis coincide")
        axis = axis / length
        radial = place - self.a
        radial = radial - np.dot(radial, axis) * axis
        distance = np.linalg.norm(radial)
        if distance <= 1e-12 * max(length, np.linalg.norm(place - self.a)):
            raise Fault("a node on the axis has no radial direction")
        radial = radial / distance
        return np.array([radial, np.cross(axis, radial), axis])


def orthonormal(a, b):
    lengths = np.linalg.norm(a), np.linalg.norm(b)
    normal = np.cross(a, b)
    if np.linalg.norm(normal) <= 1e-10 * lengths[0] * lengths[1]:
        raise Fault("the two directions of the axes are zero or parallel")
    x = a / lengths[0]
    z = normal / np.linalg.norm(normal)
    return np.array([x, np.cross(z, x), z])


def rotation_about(axis, degrees):
    """Returns the matrix of a right-handed rotation; multiples of 90° about axes are exact."""
    x, y, z = axis / np.linalg.norm(axis)
    quarter, rest = divmod(degrees, 90.0)
    angle = np.radians(rest)
    cosine, sine = np.cos(angle), np.sin(angle)
    for _ in range(int(quarter) % 4):
        cosine, sine = -sine, cosine
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    line = np.outer([x, y, z], [x, y, z])
    return cosine * np.eye(3) + sine * cross + (1 - cosine) * line
