# SPDX-License-Identifier: BSD-2-Clause
"""Nodes of a surface of faces that are within reach of another one, for import.md.

The program ties and presses areas: the parts of the faces of a slave that the master covers within
a distance, by default half the size of each of these faces, where both face each other. A node is
within reach if the master covers a part of one of its faces. Whether it does is known for a face
whose nodes are all below or above the master, and sampled at a few points for others.
"""
import numpy as np

from squeal.deck.case.projection import CALCULIX, shape_functions
from squeal.deck.topology import corners_of

THIRDS = (-2 / 3, 0, 2 / 3)
NINTHS = ((3, 3), (1, 1), (7, 1), (1, 7), (4, 4), (1, 4), (4, 1))
# Sampled points of a reference face, by its number of corners.
SAMPLES = {
    3: [(a / 9, b / 9) for a, b in NINTHS],
    4: [(a, b) for a in THIRDS for b in THIRDS],
}


def count_reached(slave, master, faces, distance):
    """Returns the numbers of nodes of the slave that are, and are not, within reach of the master.
    `distance` None: half the size of each face of the slave. Raises Fault."""
    surface = faces.surface(master.rows)
    numbers = faces.nodes_of(slave)
    reached = np.zeros(len(numbers), bool)
    if len(surface.faces):
        for _, table in faces.tables(slave.rows):
            met = _met(faces.model.nodes.at(table), surface, distance)
            reached[np.searchsorted(numbers, table[met])] = True
    count = int(np.sum(reached))
    return count, len(numbers) - count


def _met(places, surface, distance):
    """Returns for each face of one type whether the surface covers a part of it."""
    bounds = np.full(len(places), distance) if distance is not None else _sizes(places) / 2
    normals = _normals(places)
    met = np.all(_below(places, normals, surface, bounds), axis=1)
    rest = np.flatnonzero(~met)
    samples = SAMPLES[corners_of(places.shape[1])]
    values = np.array([shape_functions(places.shape[1], *at)[0] for at in samples])
    below = _below(values @ places[rest], normals[rest], surface, bounds[rest])
    met[rest] = np.any(below, axis=1)
    return met


def _below(places, normals, surface, bounds):
    """Returns for points of faces, [face][point], whether the surface faces them within the bound
    of the face. Rims of curved surfaces with different meshes do not match: a point may lie a
    little beside the surface."""
    points = places.reshape(-1, 3)
    normals = np.repeat(normals, places.shape[1], axis=0)
    reach = float(np.max(bounds, initial=0.0))
    _, distances = surface.assign(points, CALCULIX * surface.size, reach, normals)
    return distances.reshape(places.shape[:2]) <= bounds[:, None]


def _normals(places):
    """Returns a vector along the mean normal of each face."""
    corners = places[:, : corners_of(places.shape[1])]
    across = corners[:, 2] - corners[:, 0], corners[:, -1] - corners[:, 1]
    return np.cross(across[0], across[1])


def _sizes(places):
    """Returns the largest distance of two corners of each face."""
    corners = places[:, : corners_of(places.shape[1])]
    between = corners[:, :, None] - corners[:, None]
    return np.linalg.norm(between, axis=3).max(axis=(1, 2))
