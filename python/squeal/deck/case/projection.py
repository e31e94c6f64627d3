# SPDX-License-Identifier: BSD-2-Clause
"""Points on faces of cells: to which face they belong, and the nearest point there."""
import numpy as np

from squeal.deck.case.proximity import pairs_nearby

STEPS = 30
OUTSIDE = 1e-6  # of the reference face: nodes on an edge belong to it
# By this part of Surface.size a node of a tie may lie beside a triangle, and above it without
# POSITION TOLERANCE: measured with CalculiX 2.20.
CALCULIX = 0.025


# The triangles of a face with 3, 4, 6 or 8 nodes.
TRIANGLES = {
    3: ((0, 1, 2),),
    4: ((0, 1, 3), (1, 2, 3)),
    6: ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)),
    8: ((0, 4, 7), (4, 1, 5), (5, 2, 6), (6, 3, 7), (7, 4, 6), (4, 5, 6)),
}


def shape_functions(size, xi, eta):
    """Returns values and derivatives (by xi and eta) of the functions of a face with 3, 4, 6 or 8
    nodes, corners first."""
    if size in (3, 6):
        return _triangle(size, xi, eta)
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], float)
    a, b = corners.T
    if size == 4:
        return (
            (1 + a * xi) * (1 + b * eta) / 4,
            a * (1 + b * eta) / 4,
            b * (1 + a * xi) / 4,
        )
    values, by_xi, by_eta = np.zeros(8), np.zeros(8), np.zeros(8)
    values[:4] = (1 + a * xi) * (1 + b * eta) * (a * xi + b * eta - 1) / 4
    by_xi[:4] = a * (1 + b * eta) * (2 * a * xi + b * eta) / 4
    by_eta[:4] = b * (1 + a * xi) * (a * xi + 2 * b * eta) / 4
    for at, sign in ((4, -1), (6, 1)):
        values[at] = (1 - xi**2) * (1 + sign * eta) / 2
        by_xi[at], by_eta[at] = -xi * (1 + sign * eta), sign * (1 - xi**2) / 2
    for at, sign in ((5, 1), (7, -1)):
        values[at] = (1 + sign * xi) * (1 - eta**2) / 2
        by_xi[at], by_eta[at] = sign * (1 - eta**2) / 2, -eta * (1 + sign * xi)
    return values, by_xi, by_eta


def _triangle(size, xi, eta):
    third = 1 - xi - eta
    if size == 3:
        return np.array([third, xi, eta]), np.array([-1.0, 1, 0]), np.array([-1.0, 0, 1])
    values = [third * (2 * third - 1), xi * (2 * xi - 1), eta * (2 * eta - 1)]
    values += [4 * third * xi, 4 * xi * eta, 4 * eta * third]
    by_xi = [1 - 4 * third, 4 * xi - 1, 0, 4 * (third - xi), 4 * eta, -4 * eta]
    by_eta = [1 - 4 * third, 0, 4 * eta - 1, -4 * xi, 4 * xi, 4 * (third - eta)]
    return np.array(values), np.array(by_xi, float), np.array(by_eta, float)


def project(point, face):
    """Returns the point of a face that is nearest to a point: the weights of its nodes and its
    place. That is the foot of a normal, or a point of the boundary."""
    size = len(face)
    triangle = size in (3, 6)
    xi = eta = 1 / 3 if triangle else 0.0
    for _ in range(STEPS):
        values, by_xi, by_eta = shape_functions(size, xi, eta)
        tangents = np.array([by_xi @ face, by_eta @ face])
        # Gauss-Newton: the distance to a flat or slightly curved face.
        step = np.linalg.lstsq(tangents.T, point - values @ face, rcond=None)[0]
        xi, eta = xi + step[0], eta + step[1]
        if not max(abs(xi), abs(eta)) < 10:
            break
        if np.max(np.abs(step)) < 1e-13:
            break
    if triangle:
        inside = min(xi, eta, 1 - xi - eta) > -OUTSIDE
    else:
        inside = max(abs(xi), abs(eta)) < 1 + OUTSIDE
    if not inside:
        return _project_on_edges(point, face)
    values, _, _ = shape_functions(size, xi, eta)
    return values, values @ face


def _project_on_edges(point, face):
    corners = 4 if len(face) in (4, 8) else 3
    best = None
    for first in range(corners):
        nodes = [first, (first + 1) % corners, *([corners + first] if len(face) > 4 else [])]
        for start in (0.0, 0.5, 1.0):
            at = _nearest_on_edge(point, face[nodes], start)
            weights = np.zeros(len(face))
            weights[nodes] = _edge_functions(len(nodes), at)[0]
            distance = np.linalg.norm(weights @ face - point)
            if best is None or distance < best[0]:
                best = distance, weights
    return best[1], best[1] @ face


def _edge_functions(size, t):
    """Returns values and derivatives on an edge from t = 0 to 1 with the middle node last."""
    if size == 2:
        return np.array([1 - t, t]), np.array([-1.0, 1.0])
    return (
        np.array([(1 - t) * (1 - 2 * t), t * (2 * t - 1), 4 * t * (1 - t)]),
        np.array([4 * t - 3, 4 * t - 1, 4 - 8 * t]),
    )


def _nearest_on_edge(point, edge, t):
    for _ in range(STEPS):
        values, slopes = _edge_functions(len(edge), t)
        tangent = slopes @ edge
        step = np.dot(point - values @ edge, tangent) / np.dot(tangent, tangent)
        new = min(max(t + step, 0.0), 1.0)
        if abs(new - t) < 1e-14:
            break
        t = new
    return t


class Surface:
    """Faces, and the triangles by which CalculiX assigns points to them. `tables`: for each size of
    face the numbers of the faces and the coordinates of their nodes, corners first. `size`: the
    typical size of a face that sets CalculiX' tolerances, a third of the height of a triangle over
    its first node. `edge`: the mean length of the first edges."""

    def __init__(self, tables):
        count = sum(len(numbers) for numbers, _ in tables)
        self.faces = [None] * count
        owners, corners, edges = [], [np.zeros((0, 3, 3))], np.zeros(count)
        for numbers, places in tables:
            division = np.array(TRIANGLES[places.shape[1]])
            corners.append(places[:, division].reshape(-1, 3, 3))
            owners.append(np.repeat(numbers, len(division)))
            edges[numbers] = np.linalg.norm(places[:, 1] - places[:, 0], axis=1)
            for number, face in zip(numbers.tolist(), places):
                self.faces[number] = face
        self.owners = np.concatenate([np.zeros(0, np.int64), *owners])
        order = np.argsort(self.owners, kind="stable")
        self.owners, self.corners = self.owners[order], np.concatenate(corners)[order]
        sides = np.roll(self.corners, -1, axis=1) - self.corners
        normals = np.cross(sides[:, 0], sides[:, 1])
        areas = np.linalg.norm(normals, axis=1)
        lengths = np.linalg.norm(sides, axis=2)
        whole = areas > 1e-12 * lengths.max(axis=1, initial=0) ** 2  # others have collapsed
        self.owners, self.corners, sides = self.owners[whole], self.corners[whole], sides[whole]
        areas, lengths = areas[whole], lengths[whole]
        self.normals = normals[whole] / areas[:, None]
        self.outwards = np.cross(sides, self.normals[:, None]) / lengths[:, :, None]
        self.size = float(np.mean(areas / lengths[:, 1])) / 3 if len(areas) else 0.0
        self.edge = float(np.mean(edges)) if count else 0.0

    def assign(self, points, beside, reach, normals=None):
        """Returns for each point the number of its face, -1 for none, and its distance from the
        plane of a triangle of that face. A point belongs to a triangle if it lies at a distance of
        at most `reach`, beside the lines of the sides by at most `beside`, and in the bounding box
        widened by both. A triangle that contains the foot of the point comes first, then the
        nearest one. With the normals of the points, only triangles that face them count."""
        best = Nearest(len(points))
        if not len(self.corners) or not len(points):
            return best.owners, best.distances
        every = np.concatenate([points, self.corners.reshape(-1, 3)])
        reach = min(reach, float(np.linalg.norm(np.ptp(every, axis=0))))
        left = np.arange(len(points))
        level = min(reach, 3 * self.size)
        while True:
            self._compare(points, normals, left, beside, level, best)
            if level >= reach:
                return best.owners, best.distances
            left = left[~best.contained[left]]  # no triangle farther off comes before these
            level = min(reach, 4 * level)

    def _compare(self, points, normals, some, beside, reach, best):
        for at, triangles in pairs_nearby(points[some], self.corners, np.hypot(beside, reach)):
            at = some[at]
            away = points[at][:, None] - self.corners[triangles]
            aside = np.einsum("pij,pij->pi", away, self.outwards[triangles]).max(axis=1)
            distance = np.abs(np.einsum("pj,pj->p", away[:, 0], self.normals[triangles]))
            near = (aside <= beside) & (distance <= reach)
            if normals is not None:
                near &= np.einsum("pj,pj->p", normals[at], self.normals[triangles]) < 0
            contained = aside <= 1e-9 * self.size
            best.take(at[near], self.owners[triangles[near]], distance[near], contained[near])


class Nearest:
    """The best face of each point so far: one that contains its foot, and then the nearest."""

    def __init__(self, points):
        self.owners = np.full(points, -1)
        self.distances = np.full(points, np.inf)
        self.contained = np.zeros(points, bool)

    def take(self, points, owners, distances, contained):
        """Takes better faces; of equal ones the first."""
        order = np.lexsort((distances, ~contained, points))
        first = order[np.unique(points[order], return_index=True)[1]]
        at = points[first]
        closer = distances[first] < self.distances[at]
        better = np.where(contained[first] == self.contained[at], closer, contained[first])
        first, at = first[better], at[better]
        self.owners[at], self.distances[at] = owners[first], distances[first]
        self.contained[at] = contained[first]
