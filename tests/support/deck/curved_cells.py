# SPDX-License-Identifier: BSD-2-Clause
"""One curved, asymmetric element of a deck, and integrals over its faces."""
import numpy as np


def bent(points):
    """A smooth map without symmetry."""
    x, y, z = np.array(points, float).T
    return np.column_stack(
        [
            1.3 * x + 0.2 * y + 0.06 * y * z + 0.05 * z**2 + 2,
            1.1 * y - 0.1 * z + 0.07 * x**2 - 0.04 * x * z + 1,
            0.9 * z + 0.15 * x + 0.05 * x * y - 0.06 * y**2 - 1,
        ]
    )


def element(shape, curved):
    """Returns the nodes of an element in the order of the deck, and each face as the coordinates of
    its nodes, corners first."""
    corners, edges, faces = shape
    points = [np.array(corner, float) for corner in corners]
    middle = {}
    for edge in edges if curved else []:
        first, second = (int(letter) - 1 for letter in edge)
        middle[frozenset((first, second))] = len(points)
        points.append((points[first] + points[second]) / 2)
    nodes = bent(points)
    rows = []
    for face in faces:
        ends = [int(letter) - 1 for letter in face]
        between = [middle[frozenset(pair)] for pair in zip(ends, ends[1:] + ends[:1]) if middle]
        rows.append(nodes[ends + between])
    return nodes, rows


def functions(size, r, s):
    """Returns the shape functions of a face at (r, s), from their conditions at the nodes."""
    triangle = size in (3, 6)
    corners = [(0, 0), (1, 0), (0, 1)] if triangle else [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    ends = [(np.array(a) + np.array(b)) / 2 for a, b in zip(corners, corners[1:] + corners[:1])]
    places = [*corners, *ends][:size]
    powers = {3: "1 r s", 4: "1 r s rs", 6: "1 r s rr rs ss", 8: "1 r s rr rs ss rrs rss"}[size]

    def basis(r, s):
        values = {"1": 1, "r": r, "s": s}
        return np.array([np.prod([values[one] for one in word]) for word in powers.split()])

    return np.linalg.solve(np.array([basis(*place) for place in places]).T, basis(r, s))


def points_of(face):
    """Yields point and vector area n dA of a quadrature of a face, outwards if its nodes go around
    as seen from there."""
    at, weights = np.polynomial.legendre.leggauss(8)
    step = 1e-4
    for first, a in zip(at, weights):
        for second, b in zip(at, weights):
            r, s, weight = first, second, a * b
            if len(face) in (3, 6):  # the square collapsed to a triangle
                r, s = (1 + first) / 2, (1 - first) * (1 + second) / 4
                weight *= (1 - first) / 8
            place = functions(len(face), r, s) @ face
            # Central differences are exact for polynomials of degree 2.
            by_r = functions(len(face), r + step, s) - functions(len(face), r - step, s)
            by_s = functions(len(face), r, s + step) - functions(len(face), r, s - step)
            area = np.cross(by_r @ face, by_s @ face) / (4 * step**2)
            yield place, weight * area


def integrals(faces):
    """Returns volume, first moments and second moments by Gauss' theorem, and the resultants of the
    pressures 1, 2, 4, … on the faces."""
    centre = np.mean(np.concatenate(faces), axis=0)
    volume, first, second = 0.0, np.zeros(3), np.zeros((3, 3))
    force, moment = np.zeros(3), np.zeros(3)
    for number, face in enumerate(faces):
        rows = list(points_of(face))
        outwards = np.sign(sum(np.dot(area, place - centre) for place, area in rows))
        for place, area in rows:
            area = outwards * area
            volume += place @ area / 3
            first += place**2 * area / 2
            second += np.outer(place, place) * np.dot(place, area) / 5
            force -= 2**number * area
            moment -= 2**number * np.cross(place, area)
    return volume, first, second, force, moment
