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
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/deck")]
sys.dont_write_bytecode = True
from curved_cells import element, integrals

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
