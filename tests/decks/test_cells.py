#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""One curved, asymmetric element of each type through import and program: test_cells.py PROGRAM.

Mass, centre and products of inertia, and the resultants of a different pressure on each face, are
compared with integrals over the faces of the deck.
"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
import pandas as pd

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python")]
sys.dont_write_bytecode = True
from squeal.deck.importer import import_deck

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")
DENSITY, GRAVITY, SPIN2 = 3.0, (0.4, -1.1, 0.7), 2.5
# Corners, edges with a node in the middle, in the order of their numbers, and faces as the manual
# of CalculiX lists them.
HEXAHEDRON = (
    [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)],
    ["12", "23", "34", "41", "56", "67", "78", "85", "15", "26", "37", "48"],
    ["1234", "5876", "1562", "2673", "3784", "4851"],
)
WEDGE = (
    [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)],
    ["12", "23", "31", "45", "56", "64", "14", "25", "36"],
    ["123", "465", "1452", "2563", "3641"],
)
TETRAHEDRON = (
    [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
    ["12", "23", "31", "14", "24", "34"],
    ["123", "142", "243", "341"],
)
# The program integrates curved cells with so many points that polynomials of the degree of their
# volume are exact; moments have a higher degree, and their error grows with the curvature. Nodes in
# each other's place change them by more than 1e-2, or turn the cell inside out. C3D20R has the
# nodes of C3D20, and a single element of it has hourglass modes.
TYPES = {
    "C3D4": (TETRAHEDRON, False, 1e-11),
    "C3D10": (TETRAHEDRON, True, 2e-4),
    "C3D6": (WEDGE, False, 1e-11),
    "C3D15": (WEDGE, True, 2e-4),
    "C3D8": (HEXAHEDRON, False, 2e-4),
    "C3D20": (HEXAHEDRON, True, 2e-4),
}


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


class Cells(unittest.TestCase):
    def loads(self, elements, faces):
        """Returns the rows of loads of reactions.csv for elements (type, nodes), with a pressure on
        each of `faces` faces."""
        lines, held, first = [], [], 1
        for number, (kind, nodes) in enumerate(elements, 1):
            numbers = range(first, first + len(nodes))
            places = zip(numbers, nodes.tolist())
            lines += ["*NODE", *(f"{at}, {x!r}, {y!r}, {z!r}" for at, (x, y, z) in places)]
            words = [str(word) for word in (number, *numbers)]
            lines += [f"*ELEMENT, TYPE={kind}, ELSET=E"]
            lines += [", ".join(words[at : at + 16]) for at in range(0, len(words), 16)]
            held += [f"{first + at}, 1, 3" for at in range(3)]
            first += len(nodes)
        lines += ["*MATERIAL, NAME=M", "*ELASTIC", "1000., 0.2", "*DENSITY", f"{DENSITY}"]
        lines += ["*SOLID SECTION, ELSET=E, MATERIAL=M", "*BOUNDARY", *held]
        lines += ["*STEP", "*STATIC", "*DLOAD"]
        lines += [f"E, P{face + 1}, {2**face}." for face in range(faces)]
        size = np.linalg.norm(GRAVITY)
        lines += [f"E, GRAV, {size!r}, {', '.join(map(repr, GRAVITY))}"]
        lines += [f"E, CENTRIF, {SPIN2}, 0., 0., 0., 0., 0., 1.", "*END STEP"]
        with tempfile.TemporaryDirectory() as folder:
            deck = Path(folder) / "cell.inp"
            deck.write_text("\n".join(lines) + "\n")
            import_deck(deck, Path(folder) / "case")
            words = ["-options_file", f"{folder}/case/case.yaml", "-report_dir", f"{folder}/out"]
            command = [PROGRAM, *words, "-quiet", "-report_fields", "off"]
            run = subprocess.run(command, capture_output=True, text=True, check=False)
            self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
            table = pd.read_csv(f"{folder}/out/reactions.csv")
        table = table[table.kind == "load"].set_index("name")
        return {name: table.loc[name].iloc[-6:].to_numpy(float) for name in table.index}

    def test_types_in_one_body(self):
        elements, volume = [], 0.0
        for number, (kind, (shape, curved, _)) in enumerate(TYPES.items()):
            nodes, faces = element(shape, curved)
            elements.append((kind, nodes + [10 * number, 0, 0]))
            volume += integrals(faces)[0]
        weight = self.loads(elements, 0)["gravity"][:3]
        self.near(weight, DENSITY * volume * np.array(GRAVITY), 1e-11)

    def test_integrals_of_the_deck(self):
        for kind, (shape, curved, tolerance) in TYPES.items():
            with self.subTest(kind):
                nodes, faces = element(shape, curved)
                volume, first, second, force, moment = integrals(faces)
                loads = self.loads([(kind, nodes)], len(faces))
                gravity = np.array(GRAVITY)
                weight = loads["gravity"]
                self.near(weight[:3], DENSITY * volume * gravity, 1e-11)
                self.near(weight[3:], DENSITY * np.cross(first, gravity), tolerance)
                # The force ρ ω² (x, y, 0) has the moment ρ ω² (−∫yz, ∫xz, 0).
                spin = loads["spin"]
                self.near(spin[:3], DENSITY * SPIN2 * np.array([first[0], first[1], 0]), tolerance)
                turn = np.array([-second[1, 2], second[0, 2], 0])
                self.near(spin[3:], DENSITY * SPIN2 * turn, tolerance)
                self.near(loads["pressure"][:3], force, 1e-11)
                self.near(loads["pressure"][3:], moment, tolerance)

    def near(self, found, wanted, tolerance):
        self.assertLessEqual(np.max(np.abs(found - wanted)), tolerance * np.max(np.abs(wanted)))


if __name__ == "__main__":
    unittest.main()
