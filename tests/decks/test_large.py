#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Decks of a million nodes: nothing is lost, with at most 4 GB of memory. Prints the time."""
import resource
import struct
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np

repository = Path(__file__).resolve().parents[2]
SIDE = 100  # cells along each edge of a cube of hexahedra
MOST_BYTES = 4 * 1024**3

HEAD = "*NODE, NSET=ALL\n"
TAIL = """*MATERIAL, NAME=M
*ELASTIC
2.1E11, 0.3
*DENSITY
7800.
*SOLID SECTION, ELSET=BODY, MATERIAL=M
*BOUNDARY
BOTTOM, 1, 3
*STEP
*STATIC
*DSLOAD
TOP, P, 1.E6
*END STEP
*STEP
*FREQUENCY
10
*END STEP
"""


def mesh_of_cube():
    """Returns numbers and places of the nodes of a cube, and numbers and nodes of its cells."""
    counts = (SIDE + 1,) * 3
    number = np.arange(np.prod(counts)).reshape(counts) + 1
    low, high = slice(None, -1), slice(1, None)
    around = [(low, low), (low, high), (high, high), (high, low)]
    corners = [number[z, y, x] for z in (low, high) for y, x in around]
    cells = np.stack(corners, axis=-1).reshape(-1, 8)
    k, j, i = (axis.ravel() / SIDE for axis in np.indices(counts))
    return number, np.column_stack([i, j, k]), np.arange(len(cells)) + 1, cells


def write_deck(path):
    number, places, labels, cells = mesh_of_cube()
    with open(path, "w", encoding="ascii") as file:
        file.write(HEAD)
        np.savetxt(file, np.column_stack([number.ravel(), places]), "%d, %.8e, %.8e, %.8e")
        file.write("*ELEMENT, TYPE=C3D8I, ELSET=BODY\n")
        np.savetxt(file, np.column_stack([labels, cells]), "%d", delimiter=", ")
        file.write("*NSET, NSET=BOTTOM\n")
        np.savetxt(file, number[0].ravel(), "%d")
        file.write("*SURFACE, NAME=TOP\n")
        file.writelines(f"{label}, S2\n" for label in labels[-(SIDE**2) :])
        file.write(TAIL)


def write_bulk_data(path):
    """The same cube as bulk data in small fields."""
    number, places, labels, cells = mesh_of_cube()
    with open(path, "w", encoding="ascii") as file:
        file.write("SOL 103\nCEND\nSPC = 1\nSUBCASE 1\nLOAD = 2\nSUBCASE 2\nMETHOD = 3\n")
        file.write("STATSUB = 1\nBEGIN BULK\nPSOLID,1,1\nMAT1,1,2.1+11,,.3,7800.\nEIGRL,3,,,10\n")
        form = "GRID    %8d        %8.6f%8.6f%8.6f"
        np.savetxt(file, np.column_stack([number.ravel(), places]), form)
        form = "CHEXA   %8d       1" + "%8d" * 6 + "+\n+       %8d%8d"
        np.savetxt(file, np.column_stack([labels, cells]), form)
        file.write(f"SPC1,1,123456,1,THRU,{(SIDE + 1) ** 2}\n")
        top = slice(-(SIDE**2), None)
        ends = cells[top][:, [4, 6]]
        np.savetxt(file, np.column_stack([labels[top], ends]), "PLOAD4,2,%d,1.+6,,,,%d,%d")


class Large(unittest.TestCase):
    def test_a_million_nodes(self):
        self.complete("large.inp", write_deck)

    def test_a_million_grids(self):
        self.complete("large.bdf", write_bulk_data)

    def complete(self, name, write):
        with tempfile.TemporaryDirectory() as folder:
            deck = Path(folder) / name
            write(deck)
            limit = resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES)
            started = time.monotonic()
            run = subprocess.run(
                [repository / "scripts/squeal-import", deck, "-o", Path(folder) / "case"],
                preexec_fn=lambda: resource.setrlimit(*limit),
                capture_output=True,
                text=True,
                check=False,
            )
            print(f"{time.monotonic() - started:.0f} s")
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertIn(f"translating {(SIDE + 1) ** 3} nodes and {SIDE**3} elements", run.stdout)
            mesh = (Path(folder) / "case/mesh.msh").read_bytes()
            account = (Path(folder) / "case/import.md").read_text()
        # The header of a section has blocks, count, least and greatest tag.
        at = mesh.index(b"$Nodes\n") + 7
        self.assertEqual(struct.unpack_from("<4Q", mesh, at)[1], (SIDE + 1) ** 3)
        at = mesh.index(b"$Elements\n") + 10
        points, quadrangles = (SIDE + 1) ** 2, SIDE**2
        self.assertEqual(
            struct.unpack_from("<4Q", mesh, at)[1], SIDE**3 + points + quadrangles, account
        )


if __name__ == "__main__":
    unittest.main()
