# SPDX-License-Identifier: BSD-2-Clause
"""Weights of the nodes of a distributed coupling of Abaqus."""
from functools import cache

import numpy as np

from squeal.deck.case.projection import shape_functions
from squeal.deck.journal import Fault

# Of the distance to the reference node over that of the furthest node.
METHODS = {
    "UNIFORM": np.ones_like,
    "LINEAR": lambda r: 1 - r,
    "QUADRATIC": lambda r: 1 - r**2,
    "CUBIC": lambda r: 1 - 3 * r**2 + 2 * r**3,
}
# Nodes in the plane of the reference coordinates, corners first, by number of corners.
TRIANGLE = ((0, 0), (1, 0), (0, 1), (0.5, 0), (0.5, 0.5), (0, 0.5))
SQUARE = ((-1, -1), (1, -1), (1, 1), (-1, 1), (0, -1), (1, 0), (0, 1), (-1, 0))
# Pieces of a face between its nodes, as quadrangles; a triangle has its last node twice.
PIECES = {
    3: ((0, 1, 2, 2),),
    4: ((0, 1, 2, 3),),
    6: ((0, 3, 5, 5), (1, 4, 3, 3), (2, 5, 4, 4), (3, 4, 5, 5)),
    8: ((0, 4, 7, 7), (1, 5, 4, 4), (2, 6, 5, 5), (3, 7, 6, 6), (4, 5, 6, 7)),
}
POINTS = 3  # of the quadrature in each direction of a piece


def coupling_weights(rigid, nodes, model, faces, journal):
    """Returns the nodes, of these, with a positive weight, and the weights: areas of the surface if
    it has faces, otherwise 1, times the weighting method."""
    surface = model.surfaces[rigid.surface]
    weights = np.ones(len(nodes))
    if surface.nodes is None:
        weights = _areas(surface, nodes, model, faces)
        journal.choose(f"{rigid.source}: the weights of nodes are the areas of faces next to them")
    away = np.linalg.norm(model.nodes.at(nodes) - model.nodes.at([rigid.reference]), axis=1)
    furthest = max(np.max(away, initial=0.0), np.finfo(float).tiny)
    weights = weights * METHODS[rigid.weighting](away / furthest)
    heavy = weights > 1e-12 * np.max(weights, initial=0.0)
    if not np.any(heavy):
        raise Fault(f"with {rigid.weighting} the weights of all nodes are 0", "WEIGHTING METHOD")
    if not np.all(heavy):
        journal.choose(f"{rigid.source}: {np.sum(~heavy)} nodes have the weight 0")
    return np.asarray(nodes, np.int64)[heavy], weights[heavy]


def _areas(surface, nodes, model, faces):
    """Returns for each node its share of the areas of the faces of a surface."""
    numbers, areas = np.unique(nodes), np.zeros(len(np.unique(nodes)))
    for _, table in faces.tables(surface.rows):
        found = shares(model.nodes.at(table.ravel()).reshape(*table.shape, 3))
        known = np.isin(table, numbers)
        np.add.at(areas, np.searchsorted(numbers, table[known]), found[known])
    return areas[np.searchsorted(numbers, nodes)]


def shares(places):
    """Returns the areas that belong to the nodes of faces (face, node, coordinate): the integrals
    of functions that are 1 at their node, 0 at the others, and linear on the pieces of the face.
    Without nodes on edges these are the shape functions, so that the weighted mean is that of the
    face. With them all areas are positive, which those of the shape functions are not."""
    areas = np.zeros(places.shape[:2])
    for weight, values, by_xi, by_eta in _quadrature(places.shape[1]):
        tangents = (np.einsum("n,fnc->fc", slopes, places) for slopes in (by_xi, by_eta))
        area = weight * np.linalg.norm(np.cross(*tangents), axis=1)
        areas += area[:, None] * values
    return areas


@cache
def _quadrature(size):
    """Returns the points of a face with 3, 4, 6 or 8 nodes: weight, values of the functions of
    shares(), and derivatives of the shape functions."""
    nodes = np.array(TRIANGLE if size in (3, 6) else SQUARE, float)[:size]
    found = []
    gauss = list(zip(*np.polynomial.legendre.leggauss(POINTS)))
    for piece in PIECES[size]:
        for (a, weight), (b, other) in ((one, two) for one in gauss for two in gauss):
            bilinear, *slopes = shape_functions(4, a, b)
            scale = np.linalg.det([slope @ nodes[list(piece)] for slope in slopes])
            values = np.zeros(size)
            np.add.at(values, list(piece), bilinear)
            _, by_xi, by_eta = shape_functions(size, *(bilinear @ nodes[list(piece)]))
            found.append((weight * other * scale, values, by_xi, by_eta))
    return found
