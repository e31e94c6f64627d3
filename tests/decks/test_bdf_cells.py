#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""One curved, asymmetric element of each type of Nastran through import and program:
test_bdf_cells.py PROGRAM.

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
DENSITY, GRAVITY, TURNS = 3.0, (0.4, -1.1, 0.7), 0.3
SPIN2 = (2 * np.pi * TURNS) ** 2
# Corners, edges with a node in the middle, in the order of their grids, and faces, as the quick
# reference guide of Nastran draws them.
SHAPES = {
    "CHEXA": (
        [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)],
        ["12", "23", "34", "41", "15", "26", "37", "48", "56", "67", "78", "85"],
        ["1234", "5876", "1562", "2673", "3784", "4851"],
    ),
    "CPENTA": (
        [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1)],
        ["12", "23", "31", "14", "25", "36", "45", "56", "64"],
        ["123", "465", "1452", "2563", "3641"],
    ),
    "CPYRAM": (
        [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.3, 0.4, 1)],
        ["12", "23", "34", "41", "15", "25", "35", "45"],
        ["1234", "125", "235", "345", "415"],
    ),
    "CTETRA": (
        [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
        ["12", "23", "31", "14", "24", "34"],
        ["123", "142", "243", "341"],
    ),
}
# Moments have a higher degree than volumes, and their error grows with the curvature.
MOMENTS = {"CHEXA": 2e-4, "CPENTA": 2e-4, "CPYRAM": 3e-4, "CTETRA": 2e-4}


def grids_of_face(name, face, corners):
    """Returns the grids G1 and G3 (of a tetrahedron G4) that name a face in PLOAD4."""
    ends = [int(letter) for letter in face]
    if name == "CTETRA":
        return ends[0], ({1, 2, 3, 4} - set(ends)).pop()
    if len(ends) == 4:
        return ends[0], ends[2]
    if name == "CPYRAM":
        return tuple(one for one in ends if one <= 4)
    return ends[0], ""


def straightened(name, nodes, missing):
    """Returns the nodes of an element whose edges without a node are straight."""
    corners, edges, _ = SHAPES[name]
    nodes = nodes.copy()
    for at in missing:
        ends = [int(letter) - 1 for letter in edges[at]]
        nodes[len(corners) + at] = nodes[ends].mean(axis=0)
    return nodes


def faces_of(name, nodes):
    """Returns the coordinates of the nodes of each face, corners first."""
    corners, edges, faces = SHAPES[name]
    middle = {frozenset(edge): len(corners) + at for at, edge in enumerate(edges)}
    rows = []
    for face in faces:
        ring = [int(letter) - 1 for letter in face]
        if len(nodes) > len(corners):
            ring += [middle[frozenset(pair)] for pair in zip(face, face[1:] + face[:1])]
        rows.append(nodes[ring])
    return rows


def deck(name, nodes, missing=()):
    """Returns the deck of an element with pressures, weight and spin."""
    corners, _, faces = SHAPES[name]
    lines = ["SOL 101", "CEND", "SPC = 1", "LOAD = 9", "BEGIN BULK"]
    lines += [f"GRID*,{at},,{x!r},{y!r},\n*,{z!r}" for at, (x, y, z) in enumerate(nodes, 1)]
    absent = {len(corners) + at + 1 for at in missing}
    grids = ["" if at in absent else str(at) for at in range(1, len(nodes) + 1)]
    words = ["1", "1", *grids]
    rows = [",".join(words[at : at + 8]) for at in range(0, len(words), 8)]
    lines += [f"{name}," + "\n,".join(rows)]
    lines += ["PSOLID,1,1", f"MAT1,1,1000.,,0.2,{DENSITY}", "SPC1,1,123,1,2,3"]
    for number, face in enumerate(faces):
        first, second = grids_of_face(name, face, corners)
        lines.append(f"PLOAD4,3,1,{2.0**number},,,,{first},{second}")
    x, y, z = GRAVITY
    lines += [f"GRAV,4,,2.,{x / 2!r},{y / 2!r},{z / 2!r}", f"RFORCE,5,,,{TURNS / 2},0.,0.,2.,2"]
    lines += ["LOAD,9,2.,.5,3,.5,4,.5,5", "ENDDATA"]
    return "\n".join(lines) + "\n"


class Cells(unittest.TestCase):
    def loads(self, text):
        """Returns the rows of loads of reactions.csv."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "cell.bdf"
            path.write_text(text)
            import_deck(path, Path(folder) / "case")
            words = ["-options_file", f"{folder}/case/case.yaml", "-report_dir", f"{folder}/out"]
            command = [PROGRAM, *words, "-quiet", "-report_fields", "off"]
            run = subprocess.run(command, capture_output=True, text=True, check=False)
            self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
            table = pd.read_csv(f"{folder}/out/reactions.csv")
        table = table[table.kind == "load"].set_index("name")
        return {name: table.loc[name].iloc[-6:].to_numpy(float) for name in table.index}

    def compare(self, name, nodes, missing=(), tolerance=1e-11):
        loads = self.loads(deck(name, nodes, missing))
        faces = faces_of(name, straightened(name, nodes, missing))
        volume, first, second, force, moment = integrals(faces)
        gravity = np.array(GRAVITY)
        self.near(loads["gravity"][:3], DENSITY * volume * gravity, 1e-11)
        self.near(loads["gravity"][3:], DENSITY * np.cross(first, gravity), tolerance)
        # The force ρ ω² (x, y, 0) has the moment ρ ω² (−∫yz, ∫xz, 0).
        spin = loads["spin"]
        self.near(spin[:3], DENSITY * SPIN2 * np.array([first[0], first[1], 0]), tolerance)
        turn = np.array([-second[1, 2], second[0, 2], 0])
        self.near(spin[3:], DENSITY * SPIN2 * turn, tolerance)
        self.near(loads["pressure"][:3], force, 1e-11)
        self.near(loads["pressure"][3:], moment, tolerance)

    def near(self, found, wanted, tolerance):
        self.assertLessEqual(np.max(np.abs(found - wanted)), tolerance * np.max(np.abs(wanted)))

    def test_elements_with_corners_only(self):
        for name, shape in SHAPES.items():
            with self.subTest(name):
                nodes, _ = element(shape, False)
                exact = name == "CTETRA" or name == "CPENTA"
                self.compare(name, nodes, (), 1e-11 if exact else MOMENTS[name])

    def test_elements_with_all_nodes(self):
        for name, shape in SHAPES.items():
            with self.subTest(name):
                nodes, _ = element(shape, True)
                self.compare(name, nodes, (), MOMENTS[name])

    def test_elements_without_some_nodes(self):
        """Edges without a node are straight."""
        for name, missing in (
            ("CHEXA", (0, 5)),
            ("CHEXA", tuple(range(1, 12))),
            ("CPENTA", (3, 4, 5)),
            ("CTETRA", (0, 1, 2, 4)),
        ):
            with self.subTest(name, missing=missing):
                nodes, _ = element(SHAPES[name], True)
                self.compare(name, nodes, missing, MOMENTS[name])


if __name__ == "__main__":
    unittest.main()
