#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""One cantilever as a deck of CalculiX and in each form of fields of Nastran: test_bdf.py PROGRAM.

The cases have the same mesh and options, and the program finds the same frequencies. Joints of
Nastran are compared with closed forms.
"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
import pandas as pd
import yaml

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / name) for name in ("python", "tests/support/deck", "tests/decks")]
sys.dont_write_bytecode = True
from bars import grid
from small_decks import read_mesh
from write_bdf import FORMS, free

from squeal.deck.importer import import_deck

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")
END = 900
UNIT = 1e8  # of stiffness: frequencies in kHz, which are written with six decimals
SPRINGS = free("PBUSH", 4, "K", *(UNIT * value for value in (10.0, 20.0, 30.0, 40.0, 50.0, 60.0)))
# Nodes of hexahedra in the order of Nastran: the edges between the faces are before the top.
ORDER = [*range(12), *range(16, 20), *range(12, 16)]
CONTROL = """SOL 103
CEND
SPC = 1
SUBCASE 1
  LOAD = 2
SUBCASE 2
  METHOD = 3
  STATSUB = 1
BEGIN BULK
"""


def bar():
    """Returns places by node, elements, and nodes at both ends of a bar with few digits."""
    number, places, elements = grid(
        (4, 1, 1), (4.0, 1.0, 0.5), lambda x, y, z: (x, y + 0.125 * x * z, z - 0.0625 * x)
    )
    root = [at for index, at in number.items() if index[0] == 0]
    tip = [at for index, at in number.items() if index[0] == 8]
    return dict(zip(number.values(), places)), elements, root, tip


def nastran(form):
    places, elements, root, tip = bar()
    card = FORMS[form]
    lines = [card("GRID", at, None, *map(float, place)) for at, place in places.items()]
    lines.append(card("GRID", END, None, 4.5, 0.5, 0.25))
    lines += [
        card("CHEXA", at, 1, *(element[one] for one in ORDER))
        for at, element in enumerate(elements, 1)
    ]
    lines += [card("PSOLID", 1, 1), card("MAT1", 1, 2.0e5, None, 0.25, 8.0e-9)]
    lines += [card("SPC1", 1, 123, *root), card("RBE2", 7, END, 123456, *tip)]
    lines += [card("FORCE", 2, END, None, 2.0, 100.0, 0.0, -10.0), card("EIGRL", 3, None, None, 4)]
    return CONTROL + "".join(lines) + "ENDDATA\n"


def calculix():
    places, elements, root, tip = bar()
    lines = ["*NODE", *(f"{at}, {x!r}, {y!r}, {z!r}" for at, (x, y, z) in places.items())]
    lines += [f"{END}, 4.5, 0.5, 0.25", "*ELEMENT, TYPE=C3D20, ELSET=psolid_1"]
    for at, element in enumerate(elements, 1):
        lines += [", ".join(map(str, [at, *element[:10]])) + ",", ", ".join(map(str, element[10:]))]
    for name, nodes in (("spc_1", root), ("rbe2_7", tip)):
        lines += [f"*NSET, NSET={name}", *(f"{at}," for at in nodes)]
    lines += ["*SURFACE, NAME=rbe2_7, TYPE=NODE", "rbe2_7,"]
    lines += [f"*COUPLING, REF NODE={END}, SURFACE=rbe2_7, CONSTRAINT NAME=rbe2_7"]
    lines += ["*KINEMATIC", "1, 3", "*MATERIAL, NAME=1", "*ELASTIC", "2.E5, 0.25"]
    lines += ["*DENSITY", "8.E-9", "*SOLID SECTION, ELSET=psolid_1, MATERIAL=1"]
    lines += ["*BOUNDARY", "spc_1, 1, 3", "*STEP", "*STATIC", "*CLOAD"]
    lines += [f"{END}, 1, 200.", f"{END}, 3, -20.", "*END STEP"]
    lines += ["*STEP, PERTURBATION", "*FREQUENCY", "4", "*END STEP"]
    return "\n".join(lines) + "\n"


def run(name, text, **words):
    """Returns options, mesh and table of the free modes of a deck."""
    with tempfile.TemporaryDirectory() as folder:
        deck = Path(folder) / name
        deck.write_text(text)
        import_deck(deck, Path(folder) / "case", **words)
        options = yaml.safe_load((Path(folder) / "case/case.yaml").read_text())
        mesh = read_mesh(Path(folder) / "case/mesh.msh")
        files = ["-options_file", f"{folder}/case/case.yaml", "-report_dir", f"{folder}/out"]
        command = [PROGRAM, *files, "-quiet", "-report_fields", "off"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            raise AssertionError(done.stdout + done.stderr)
        return options, mesh, pd.read_csv(f"{folder}/out/eigenvalues.csv")


def frequencies(table):
    return np.sort(table["frequency_hz"].to_numpy(float))


class Cantilever(unittest.TestCase):
    def test_all_forms_are_one_case(self):
        wanted, (groups, nodes, places), table = run("bar.inp", calculix(), dialect="calculix")
        for form in FORMS:
            with self.subTest(form):
                options, mesh, own = run("bar.bdf", nastran(form))
                self.assertEqual(options, wanted)
                self.assertEqual(mesh[0], groups)
                np.testing.assert_array_equal(mesh[1], nodes)
                np.testing.assert_array_equal(mesh[2], places)
                np.testing.assert_array_equal(frequencies(own), frequencies(table))


class Joints(unittest.TestCase):
    """A cube on springs, whose stiffness is far below its own, moves as a rigid body."""

    MASS, EDGE = 8.0, 2.0

    def cube(self, cards, modes=6, young=1.0e12, control="SOL 103\nCEND\nMETHOD = 3\nBEGIN BULK\n"):
        corners = [(x, y, z) for z in (-1.0, 1.0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        lines = [free("GRID", at, None, *map(float, one)) for at, one in enumerate(corners, 1)]
        lines += [free("CHEXA", 1, 1, *range(1, 9)), free("PSOLID", 1, 1)]
        lines += [free("MAT1", 1, young, None, 0.0, self.MASS / self.EDGE**3)]
        lines += [free("GRID", 20, None, 0.0, 0.0, 0.0), free("RBE2", 30, 20, 123456, *range(1, 9))]
        return control + "".join(lines) + cards + free("EIGRL", 3, None, None, modes)

    def squares(self, cards):
        """Returns the squares of the angular frequencies of the six motions, in the unit of the
        stiffness."""
        _, _, table = run("cube.bdf", self.cube(cards))
        return (2 * np.pi * frequencies(table)) ** 2 / UNIT

    def test_bushing_and_inertia(self):
        """The CONM2 has another inertia about each axis; the bushing is turned."""
        cards = SPRINGS
        cards += free("CBUSH", 5, 4, 20, None, None, None, None, 6)
        cards += free("CORD2R", 6, None, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0)
        # Axes of system 6: x is y of the basic one, y is z, z is x.
        cards += free("CONM2", 7, 20, 6, 2.0, 0.0, 0.0, 0.0, None, 3.0, 0.0, 4.0, 0.0, 0.0, 5.0)
        own = self.MASS * self.EDGE**2 / 6
        wanted = [10 / 10, 20 / 10, 30 / 10, 40 / (own + 3), 50 / (own + 4), 60 / (own + 5)]
        np.testing.assert_allclose(self.squares(cards), np.sort(wanted), rtol=1e-8)

    def test_masses_with_an_offset(self):
        """The frequencies of a rigid body whose centre is not at the bushing."""
        cards = SPRINGS
        cards += free("CBUSH", 5, 4, 20, None, None, None, None, 0)
        products = (3.0, 0.5, 4.0, -0.25, 0.75, 5.0)  # I11, I21, I22, I31, I32, I33
        cards += free("CONM2", 7, 20, None, 2.0, 0.5, -0.25, 1.0, None, *products)
        own = self.MASS * self.EDGE**2 / 6
        one, two_one, two, three_one, three_two, three = products
        inertia = own * np.eye(3) + np.array(
            [
                [one, -two_one, -three_one],
                [-two_one, two, -three_two],
                [-three_one, -three_two, three],
            ]
        )
        arm, mass = np.array([0.5, -0.25, 1.0]), np.zeros((6, 6))
        cross = np.array([[0, -arm[2], arm[1]], [arm[2], 0, -arm[0]], [-arm[1], arm[0], 0]])
        mass[:3, :3] = 10 * np.eye(3)
        mass[:3, 3:] = -2 * cross
        mass[3:, :3] = mass[:3, 3:].T
        mass[3:, 3:] = inertia - 2 * cross @ cross
        stiffness = np.diag([10.0, 20.0, 30.0, 40.0, 50.0, 60.0])
        wanted = np.sort(np.linalg.eigvals(np.linalg.solve(mass, stiffness)).real)
        np.testing.assert_allclose(self.squares(cards), wanted, rtol=1e-8)

    def test_springs_between_components(self):
        """Springs to the ground along and about the axes of the reference grid, one of them between
        two components: k (u1 − u2)²."""
        cards = "".join(
            free("CELAS2", 40 + at, 10.0 * at * UNIT, 20, at) for at in range(1, 7)
        ) + free("CELAS2", 50, 7.0 * UNIT, 20, 1, 20, 2)
        own = self.MASS * self.EDGE**2 / 6
        plane = np.array([[10.0 + 7, -7], [-7, 20.0 + 7]]) / self.MASS
        wanted = [*np.linalg.eigvalsh(plane), 30 / self.MASS, *(np.array([40.0, 50, 60]) / own)]
        np.testing.assert_allclose(self.squares(cards), np.sort(wanted), rtol=1e-8)

    def test_distributed_forces(self):
        """Springs at a grid that follows the mean of four corners by RBE3 hold the rigid cube as if
        it were part of it."""
        cards = free("GRID", 21, None, 0.5, -0.5, 3.0)
        cards += free("RBE3", 31, None, 21, 123456, 2.0, 123, 5, 6, 7, 8)
        cards += SPRINGS
        cards += free("CBUSH", 5, 4, 21, None, None, None, None, 0)
        self.rigid(cards)

    def test_distributed_forces_by_equations(self):
        """The same for REFC in two elements, and components in the axes of a cylinder."""
        cards = free("GRID", 21, None, 0.5, -0.5, 3.0)
        cards += free("RBE3", 31, None, 21, 124, 2.0, 12, 5, 6, 7, 8, 1.0, 3, 5, 6, 7)
        cards += free("RBE3", 32, None, 21, 356, 2.0, 123, 5, 6, 7)
        cards += SPRINGS
        cards += free("CBUSH", 5, 4, 21, None, None, None, None, 0)
        self.rigid(cards)

    def rigid(self, cards):
        arm = np.array([0.5, -0.5, 3.0])
        cross = np.array([[0, -arm[2], arm[1]], [arm[2], 0, -arm[0]], [-arm[1], arm[0], 0]])
        turn = np.eye(6)
        turn[:3, 3:] = -cross
        stiffness = turn.T @ np.diag([10.0, 20, 30, 40, 50, 60]) @ turn
        own = self.MASS * self.EDGE**2 / 6
        mass = np.diag([self.MASS] * 3 + [own] * 3)
        wanted = np.sort(np.linalg.eigvals(np.linalg.solve(mass, stiffness)).real)
        lines = self.cube(cards, 11, 3.0e16).replace(free("RBE2", 30, 20, 123456, *range(1, 9)), "")
        _, _, table = run("cube.bdf", lines)
        found = (2 * np.pi * frequencies(table)[:6]) ** 2 / UNIT
        np.testing.assert_allclose(found, wanted, rtol=1e-6)


if __name__ == "__main__":
    unittest.main()
