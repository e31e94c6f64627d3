# SPDX-License-Identifier: BSD-2-Clause
"""Points projected onto faces of cells along the normal of the face."""
import numpy as np

CANDIDATES = 8  # nearest faces that are tried for a point
STEPS = 30
OUTSIDE = 1e-6  # of the reference face: nodes on an edge belong to it


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


def project(point, corners):
    """Returns the foot of a point on a face: weights of its nodes and their place, or None if the
    foot lies outside the face or Newton's method does not find it."""
    size = len(corners)
    triangle = size in (3, 6)
    xi = eta = 1 / 3 if triangle else 0.0
    for _ in range(STEPS):
        values, by_xi, by_eta = shape_functions(size, xi, eta)
        tangents = np.array([by_xi @ corners, by_eta @ corners])
        # Gauss-Newton: the distance to a flat or slightly curved face.
        step = np.linalg.lstsq(tangents.T, point - values @ corners, rcond=None)[0]
        xi, eta = xi + step[0], eta + step[1]
        if not max(abs(xi), abs(eta)) < 10:
            return None
        if np.max(np.abs(step)) < 1e-13:
            break
    inside = (
        min(xi, eta, 1 - xi - eta) > -OUTSIDE if triangle else max(abs(xi), abs(eta)) < 1 + OUTSIDE
    )
    if not inside:
        return None
    values, _, _ = shape_functions(size, xi, eta)
    return values, values @ corners


class Surface:
    """Faces, each an array of coordinates of its nodes, with the edge length that is typical."""

    def __init__(self, faces):
        self.faces = faces
        size = [4 if len(face) in (4, 8) else 3 for face in faces]
        self.centres = np.array([face[:count].mean(axis=0) for face, count in zip(faces, size)])
        edges = [
            np.linalg.norm(face[:count] - np.roll(face[:count], 1, axis=0), axis=1).mean()
            for face, count in zip(faces, size)
        ]
        self.size = float(np.mean(edges))

    def foot(self, point):
        """Returns number of the face, weights, place and distance of the nearest foot, or None."""
        distances = np.linalg.norm(self.centres - point, axis=1)
        best = None
        for number in np.argsort(distances, kind="stable")[:CANDIDATES]:
            found = project(point, self.faces[number])
            if found is not None:
                distance = np.linalg.norm(found[1] - point)
                if best is None or distance < best[3] - 1e-12 * self.size:
                    best = int(number), *found, distance
        return best
