#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Matrices of other programs, imported and solved: a chain of masses in all formats against its
closed form, and a cantilever of CalculiX against CalculiX's own frequencies."""
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np
import pandas as pd

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/matrices")]
sys.path.insert(0, str(repository / "tests/decks"))
sys.dont_write_bytecode = True
PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")
import ccx
import matrix_files as files
from imported import InFolder

COUNT = 12


def cantilever(solver=""):
    """Returns the deck of a bar of 6 cells, 60 long, 7 wide and 5 high, clamped at one end."""
    count = 6

    def number(i, j, k):
        return 1 + i + (2 * count + 1) * (j + 3 * k)

    lines = ["*NODE, NSET=ALL"]
    for i in range(2 * count + 1):
        for j in range(3):
            for k in range(3):
                if (i % 2) + (j % 2) + (k % 2) < 2:  # corners and the middles of edges
                    lines.append(f"{number(i, j, k)}, {5.0 * i}, {3.5 * j}, {2.5 * k}")
    lines.append("*ELEMENT, TYPE=C3D20, ELSET=BAR")
    square = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1))
    for cell in range(count):
        corners = [(*one, k) for k in (0, 2) for one in square[:4]]
        middles = [(*one, k) for k in (0, 2) for one in square[4:]]
        upright = [(*one, 1) for one in square[:4]]
        nodes = [number(2 * cell + i, j, k) for i, j, k in [*corners, *middles, *upright]]
        lines.append(", ".join(map(str, [cell + 1, *nodes[:10]])) + ",")
        lines.append(", ".join(map(str, nodes[10:])))
    wall = [number(0, j, k) for j in range(3) for k in range(3) if (j % 2) + (k % 2) < 2]
    lines += ["*NSET, NSET=WALL", ", ".join(map(str, wall)), "*MATERIAL, NAME=STEEL", "*ELASTIC"]
    lines += ["210000., 0.3", "*DENSITY", "7.8E-9", "*SOLID SECTION, ELSET=BAR, MATERIAL=STEEL"]
    lines += ["*BOUNDARY", "WALL, 1, 3", "*STEP", f"*FREQUENCY{solver}", "12", "*END STEP"]
    return "\n".join(lines) + "\n"


class Solved(InFolder):
    def call(self, *words, status=0):
        """Runs squeal-import and returns its output."""
        command = [repository / "scripts/squeal-import", *map(str, words)]
        run = subprocess.run(command, capture_output=True, text=True, check=False, cwd=self.folder)
        self.assertEqual(run.returncode, status, run.stdout + run.stderr)
        self.assertNotIn("Traceback", run.stderr)
        return run.stdout + run.stderr

    def solve(self, folder, *words):
        """Runs the program, and returns the circular frequencies and growth rates."""
        command = [PROGRAM, "-options_file", self.folder / folder / "case.yaml", "-quiet"]
        command += ["-report_dir", self.folder / folder / "results", "-checkpoint", "off", *words]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        return pd.read_csv(self.folder / folder / "results/eigenvalues.csv", comment="#")

    def test_chain_in_all_formats(self):
        stiffness, mass, exact = files.chain(COUNT)
        names = files.names(COUNT)
        self.write("j.dof", files.dof(names))
        self.write("h.mapping", files.mapping(names))
        both = {"KAA": stiffness, "MAA": mass}
        pairs = {}
        for name, write, suffix in (
            ("abaqus_lower", lambda one: files.abaqus(one, "lower"), ".mtx"),
            ("abaqus_all", lambda one: files.abaqus(one, "all"), ".mtx"),
            ("coordinates", files.coordinates, ".mtx"),
            ("harwell_boeing", lambda one: files.harwell_boeing(one, sides=1), ".matrix"),
            ("matrix_market", files.matrix_market, ".mm"),
        ):
            paths = [self.write(f"{name}_{one}{suffix}", write(both[one])) for one in both]
            pairs[name] = paths
        self.write("j.sti", files.calculix(stiffness))
        self.write("j.mas", files.calculix(mass))
        pairs["calculix"] = [self.folder / "j.sti", self.folder / "j.mas"]
        for name, data in (
            ("op4_text", files.op4_text(both, "bigmat")),
            ("op4_little", files.op4_binary(both, "sparse", "<")),
            ("op4_big", files.op4_binary(both, "dense", ">", 8)),
            ("dmig", files.dmig(both)),
            ("dmig_square", files.dmig(both, "free", 1)),
        ):
            path = self.write(name, data)
            pairs[name] = [f"{path}:KAA", f"{path}:MAA"]
        contents = {}
        for name, (one, other) in pairs.items():
            out = self.folder / f"case_{name}"
            self.call("--stiffness", one, "--mass", other, "-o", out)
            files_of_case = ("stiffness.petsc", "mass.petsc")
            contents[name] = [(out / part).read_bytes() for part in files_of_case]
            self.assertEqual(contents[name], contents["abaqus_lower"], name)
        found = self.solve("case_abaqus_lower")
        np.testing.assert_allclose(found.angular_frequency_rad_per_s, exact, rtol=1e-10)

    def test_friction_of_two_unknowns(self):
        """A mass on a belt (options/external.yaml) flutters above the friction 0.75."""
        belt = {
            "stiffness": np.array([[3.0, -1], [-1, 3]]),
            "mass": np.eye(2),
            "friction": np.array([[0.0, 1], [0, 0]]),
        }
        words = []
        for role, matrix in belt.items():
            words += [f"--{role}", self.write(f"{role}.mtx", files.abaqus(matrix, "all"))]
        self.call(*words, "-o", "belt")
        found = self.solve("belt")
        # (3 + s^2)^2 = (-1 + f) (-1): the roots collide at f = 1 and flutter beyond it.
        self.assertEqual(set(found.friction[found.growth_rate_1_per_s > 1e-6]), set())
        text = (self.folder / "belt/case.yaml").read_text().replace("0:1:0.1", "1.5")
        (self.folder / "belt/case.yaml").write_text(text)
        found = self.solve("belt")
        self.flutters(found)
        # The same by the stiffness without friction and that with friction 0.5.
        whole = belt["stiffness"] + 0.5 * belt["friction"]
        self.write("k0.mtx", files.abaqus(belt["stiffness"]))
        self.write("k5.mtx", files.abaqus(whole, "all"))
        words = ("--stiffness", "k0.mtx", "--mass", "mass.mtx", "--friction", "k5.mtx")
        self.call(*words, "--friction", "k0.mtx", "--triangle", "friction_2", "-o", "two")
        text = (self.folder / "two/case.yaml").read_text().replace("0:1:0.1", "1.5")
        for name, factor in (("friction", 2), ("friction_2", -2)):
            text = text.replace(f"  {name}:\n", f"  {name}:\n    factor: {factor}\n")
        (self.folder / "two/case.yaml").write_text(text)
        self.flutters(self.solve("two"))

    def flutters(self, found):
        """Requires the roots at the friction 1.5, s^2 = -3 +- i sqrt(0.5)."""
        exact = np.sqrt(-3 + 1j * np.sqrt(0.5))
        self.assertAlmostEqual(found.growth_rate_1_per_s.max(), abs(exact.real), delta=1e-10)
        np.testing.assert_allclose(found.angular_frequency_rad_per_s, abs(exact.imag), rtol=1e-10)

    def test_gyroscopic_of_two_unknowns(self):
        """s^2 + s v G + k with the skew-symmetric G: sqrt(k + (v g / 2)^2) -+ v g / 2."""
        for role, text in (
            ("stiffness", files.abaqus(5.0 * np.eye(2))),
            ("mass", files.abaqus(np.eye(2))),
            ("gyroscopic", files.abaqus(np.array([[0, 4.0], [-4.0, 0]]), "all")),
        ):
            self.write(f"{role}.mtx", text)
        roles = ("stiffness", "mass", "gyroscopic")
        self.call(*(word for one in roles for word in (f"--{one}", f"{one}.mtx")), "-o", "spin")
        for speed in (1.0, 0.5):
            found = self.solve("spin", "-flutter_speed", str(speed))
            exact = [3 - 2, 3 + 2] if speed == 1 else np.sqrt(6) + np.array([-1, 1])
            np.testing.assert_allclose(found.angular_frequency_rad_per_s, exact, rtol=1e-10)

    def test_an_unknown_without_mass(self):
        """A mass on the ground spring 3, and by the springs 2 and 1 in series, which meet in a node
        without mass: s^2 = -(3 + 2 / 3)."""
        self.write("k.mtx", files.abaqus(np.array([[5.0, -2], [-2, 3]])))
        self.write("m.mtx", files.abaqus(np.array([[1.0]])))
        self.assertIn("1 rows have no mass", self.call("--stiffness", "k.mtx", "--mass", "m.mtx"))
        (found,) = self.solve("k").angular_frequency_rad_per_s
        self.assertAlmostEqual(found, np.sqrt(3 + 2 / 3), delta=1e-12)

    @unittest.skipUnless(shutil.which("ccx"), "CalculiX is not installed")
    def test_cantilever_of_calculix(self):
        self.write("bar.inp", cantilever(", SOLVER=MATRIXSTORAGE"))
        subprocess.run(["ccx", "bar"], cwd=self.folder, capture_output=True, check=False)
        self.assertIn("bar.dof: names of the rows", self.call("bar"))
        rows = (self.folder / "bar/rows.csv").read_text().splitlines()
        dof = (self.folder / "bar.dof").read_text().split()
        self.assertEqual([row.split(",", 1)[1].replace(",", ".") for row in rows[1:]], dof)
        found = self.solve("bar").frequency_hz
        wanted = ccx.Reference(cantilever(), self.folder / "ccx").frequencies
        np.testing.assert_allclose(found[: len(wanted)], wanted, rtol=1e-6)
        self.call("bar")  # although there is a folder of this name now
        self.call("bar.sti", "-o", "again")
        for name in ("stiffness.petsc", "mass.petsc", "rows.csv"):
            self.assertEqual(
                (self.folder / "bar" / name).read_bytes(),
                (self.folder / "again" / name).read_bytes(),
            )

    def test_command_line(self):
        path = self.write("k.mtx", files.abaqus(np.eye(2)))
        self.assertIn("needs a mass matrix", self.call("--stiffness", path, status=1))
        self.assertIn("docs/matrices_import.md", self.call("--help"))
        for words in (
            ("deck.inp", "--stiffness", path, "--mass", path),
            ("--stiffness", path, "--mass", path, "--whole", "friction"),
            ("--stiffness", path, "--mass", path, "--ignore", "X"),
            ("--rows", path),
            (),
        ):
            self.call(*words, status=2)
        self.call("--stiffness", path, "--stiffness", path, "--mass", path)
        self.assertEqual(
            sorted(one.name for one in (self.folder / "k").iterdir()),
            ["case.yaml", "import.md", "mass.petsc", "rows.csv", "stiffness.petsc"]
            + ["stiffness_2.petsc"],
        )
        shutil.copy(path, self.folder / "plain")
        self.call("--stiffness", "plain", "--mass", "plain")
        self.assertTrue((self.folder / "plain_case/case.yaml").is_file())
        found = self.solve("k")
        np.testing.assert_allclose(found.angular_frequency_rad_per_s, np.sqrt(2), rtol=1e-12)


if __name__ == "__main__":
    unittest.main()
