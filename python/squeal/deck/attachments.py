# SPDX-License-Identifier: BSD-2-Clause
"""Parts of a model between nodes: bushings, distributed couplings, point masses with inertia.

Their axes are global unless they have a frame.
"""
from dataclasses import dataclass

import numpy as np

from squeal.deck.journal import Source


@dataclass
class Bushing:
    """Stiffness and damping along three axes and about them, between two nodes, or from one node
    to the ground (`second` None). `frame`: its axes, None for global ones. `arms`: its ends are
    apart, so that displacements across their line depend on their rotations."""

    name: str
    first: int
    second: int
    stiffness: np.ndarray
    damping: np.ndarray
    frame: object
    source: Source
    arms: bool = False

    def components(self):
        """Returns the components of its ends that it may use; axes may be turned."""
        used = np.abs(self.stiffness) + np.abs(self.damping) > 0
        if self.frame is not None:
            used = np.repeat([np.any(used[:3]), np.any(used[3:])], 3)
        used[3:] |= self.arms
        return tuple(np.flatnonzero(used).tolist())


@dataclass
class Distributed:
    """A reference node that follows the weighted mean motion of nodes (RBE3). `label`: the name of
    their group, None for that of the coupling."""

    name: str
    reference: int
    nodes: np.ndarray
    weights: np.ndarray
    source: Source
    label: str = None


@dataclass
class PointInertia:
    """A mass of a node: `offset` is the vector from there to its centre, `inertia` the tensor about
    the centre, as a matrix."""

    name: str
    node: int
    mass: float
    offset: np.ndarray
    inertia: np.ndarray
    source: Source

    @property
    def turns(self):
        """Whether it resists rotations of its node."""
        return bool(np.any(self.offset) or np.any(self.inertia))

    def joined(self, other):
        """Returns this mass and another one of the same node as one."""
        mass = self.mass + other.mass
        parts = self, other
        if mass:
            centre = sum(one.mass * one.offset for one in parts) / mass
        else:
            centre = np.zeros(3)
        inertia = np.zeros((3, 3))
        for one in parts:
            arm = one.offset - centre
            inertia = inertia + one.inertia
            inertia = inertia + one.mass * (np.dot(arm, arm) * np.eye(3) - np.outer(arm, arm))
        return PointInertia(self.name, self.node, mass, centre, inertia, self.source)
