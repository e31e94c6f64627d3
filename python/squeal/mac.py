# SPDX-License-Identifier: BSD-2-Clause
"""The modal assurance criterion (MAC) of the modes of two runs.

    MAC(a, b) = |aᴴ W b|² / ((aᴴ W a) (bᴴ W b))

W weights the displacement of each node with its volume: a mesh that is finer in one place does not
give this place more weight. results.h5 has no mass matrix, so densities do not enter.
"""
import dataclasses

import numpy as np

from squeal.files import ResultsError

SAME_PLACE = 1e-9  # of nodes, in sizes of the mesh
# Corner nodes of the simplices that make up a cell, by the shape of the cell.
TRIANGLE = ((0, 1, 2),)
QUADRANGLE = ((0, 1, 2), (0, 2, 3))
TETRAHEDRON = ((0, 1, 2, 3),)
HEXAHEDRON = tuple((0, a, b, 6) for a, b in ((1, 2), (2, 3), (3, 7), (7, 4), (4, 5), (5, 1)))
PRISM = ((0, 1, 2, 5), (0, 1, 5, 4), (0, 4, 5, 3))
PYRAMID = ((0, 1, 2, 4), (0, 2, 3, 4))
SIMPLICES = {
    **dict.fromkeys((2, 9), TRIANGLE),  # by gmsh's element type
    **dict.fromkeys((3, 10, 16), QUADRANGLE),
    **dict.fromkeys((4, 11), TETRAHEDRON),
    **dict.fromkeys((5, 12, 17), HEXAHEDRON),
    **dict.fromkeys((6, 13, 18), PRISM),
    **dict.fromkeys((7, 14, 19), PYRAMID),
}


@dataclasses.dataclass
class Shared:
    """The rows at which the shapes of two runs are compared."""

    one: np.ndarray  # indices of the rows of the first run
    other: np.ndarray  # of the same nodes in the other one
    weights: np.ndarray
    words: str  # the kind of MAC


def nodal_volumes(mesh):
    """Returns the volume of each node, in the plane its area: equal parts of its cells."""
    places = np.pad(mesh.coordinates, ((0, 0), (0, 3 - mesh.coordinates.shape[1])))
    volumes = np.zeros(len(places))
    for kind, block in mesh.cells.items():
        nodes = block["nodes"].astype(np.int64)
        of_cells = np.zeros(len(nodes))
        for simplex in SIMPLICES[kind]:
            sides = places[nodes[:, simplex[1:]]] - places[nodes[:, simplex[:1]]]
            product = np.cross(sides[:, 0], sides[:, 1])
            if len(simplex) == 4:
                of_cells += np.einsum("ij,ij->i", product, sides[:, 2]) / 6
            else:
                of_cells += np.linalg.norm(product, axis=1) / 2
        np.add.at(volumes, nodes, np.abs(of_cells)[:, None] / nodes.shape[1])
    return volumes


def shared_rows(one, other, names=None):
    """Returns the Shared of two runs, or the reason why there is none, as a clause."""
    names = names or [str(run.folder) for run in (one, other)]
    for run, name in zip((one, other), names):
        if run.parts:
            return f"{name} is a merge, whose shapes of modes are in its parts"
        if not run.has_shapes():
            return f"{name} holds no shapes of modes (-report_fields off)"
    both = " and ".join(names)
    if (one.mesh is None) != (other.mesh is None):
        return f"only one of {both} has a mesh"
    if one.mesh is None:
        count = [run.summary.get("dofs") for run in (one, other)]
        if count[0] is None or count[0] != count[1]:
            return f"the matrices of {both} differ in size"
        rows = np.arange(count[0])
        return Shared(rows, rows, np.ones(len(rows)), "of their vectors, row by row")
    rows = same_nodes(one.mesh, other.mesh)
    if rows is None:
        count = f"{len(one.mesh.coordinates)} and {len(other.mesh.coordinates)} nodes"
        return f"the meshes of {both} differ ({count})"
    words = "of their displacements, weighted with nodal volumes"
    lost = len(one.mesh.coordinates) - len(rows[0])
    if lost:
        words += f", without {lost} nodes that share tag, place and body with another one"
    return Shared(*rows, nodal_volumes(one.mesh)[rows[0]], words)


def same_nodes(one, other):
    """Returns the indices of the nodes of two equal meshes in one order; None if nodes differ.

    The numbering of the nodes depends on the ranks. Nodes of one tag and place, on the two sides of
    a contact, are distinguished by their bodies. On the two sides of a section of a bolt they
    cannot be distinguished and are left out.
    """
    meshes = (one, other)
    if one.coordinates.shape != other.coordinates.shape or one.bodies != other.bodies:
        return None
    bodies = [_bodies_of_nodes(mesh) for mesh in meshes]
    order = [
        np.lexsort((body, *mesh.coordinates.T, mesh.tags)) for mesh, body in zip(meshes, bodies)
    ]
    keys = [
        np.stack([mesh.tags[rows], body[rows]]) for mesh, body, rows in zip(meshes, bodies, order)
    ]
    places = [mesh.coordinates[rows] for mesh, rows in zip(meshes, order)]
    close = SAME_PLACE * np.ptp(places[0], axis=0).max(initial=0)
    if not np.array_equal(*keys) or np.abs(places[0] - places[1]).max(initial=0) > close:
        return None
    again = np.all(np.diff(keys[0]) == 0, axis=0)
    again &= np.abs(np.diff(places[0], axis=0)).max(axis=1) <= close
    single = ~(np.append(again, False) | np.append(False, again))
    return order[0][single], order[1][single]


def _bodies_of_nodes(mesh):
    """Returns the number of the body of each node; -1 in no cell."""
    bodies = np.full(len(mesh.coordinates), -1)
    for block in mesh.cells.values():
        bodies[block["nodes"]] = block["body"]
    return bodies


def mac(one, other, weights=None):
    """Returns the MAC of each shape of a list with each of another list. A shape is an array
    [node, component], with a weight for each node."""
    one, other = (_scaled(shapes, weights) for shapes in (one, other))
    return np.abs(one.conj() @ other.T) ** 2


def _scaled(shapes, weights):
    """The shapes as rows of a matrix, scaled to √W a / √(aᴴ W a)."""
    rows = np.stack([np.asarray(shape).reshape(len(shape), -1) for shape in shapes])
    if weights is not None:
        rows = rows * np.sqrt(weights)[None, :, None]
    rows = rows.reshape(len(rows), -1)
    sizes = np.linalg.norm(rows, axis=1)
    if not np.all(np.isfinite(sizes)) or not np.all(sizes > 0):
        raise ResultsError("a shape of a mode is zero or not finite")
    return rows / sizes[:, None]


__all__ = ["Shared", "mac", "nodal_volumes", "same_nodes", "shared_rows"]
