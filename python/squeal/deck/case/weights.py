# SPDX-License-Identifier: BSD-2-Clause
"""Weights of the nodes of a distributed coupling of Abaqus."""
import numpy as np

from squeal.deck.journal import Fault

# Of the distance to the reference node over that of the furthest node.
METHODS = {
    "UNIFORM": np.ones_like,
    "LINEAR": lambda r: 1 - r,
    "QUADRATIC": lambda r: 1 - r**2,
    "CUBIC": lambda r: 1 - 3 * r**2 + 2 * r**3,
}
SUBTRIANGLES = {
    3: ((0, 1, 2),),
    4: (),
    6: ((0, 3, 5), (1, 4, 3), (2, 5, 4), (3, 4, 5)),
    8: ((0, 4, 7), (1, 5, 4), (2, 6, 5), (3, 7, 6)),
}
QUADRANGLES = {4: (0, 1, 2, 3), 8: (4, 5, 6, 7)}


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
    """Returns for each node the part of the surface that is nearest to it. Faces with nodes on
    their edges are divided into triangles and quadrangles between their nodes."""
    numbers, areas = np.unique(nodes), np.zeros(len(np.unique(nodes)))
    for _, table in faces.tables(surface.rows):
        found = shares(model.nodes.at(table.ravel()).reshape(*table.shape, 3))
        known = np.isin(table, numbers)
        np.add.at(areas, np.searchsorted(numbers, table[known]), found[known])
    return areas[np.searchsorted(numbers, nodes)]


def shares(places):
    """Returns the areas that belong to the nodes of faces (face, node, coordinate)."""
    count = places.shape[1]
    areas = np.zeros(places.shape[:2])
    for triangle in SUBTRIANGLES[count]:
        a, b, c = (places[:, at] for at in triangle)
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
        areas[:, triangle] += area[:, None] / 3
    corners = QUADRANGLES.get(count, ())
    centre = places[:, corners].mean(axis=1) if corners else None
    for at, corner in enumerate(corners):
        # The quadrangle of the corner, the centre, and the middles of both edges.
        after, before = (places[:, corners[(at + step) % 4]] for step in (1, -1))
        diagonals = centre - places[:, corner], (after - before) / 2
        areas[:, corner] += np.linalg.norm(np.cross(*diagonals), axis=1) / 2
    return areas
