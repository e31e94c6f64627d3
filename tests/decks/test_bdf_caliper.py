#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""A floating caliper as bulk data, against the case that it was made from: test_bdf_caliper.py
PROGRAM [MPIEXEC]. All eigenvalues agree, on one rank and on two."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / one) for one in ("python", "tests/support/deck", "tests/decks")]
sys.dont_write_bytecode = True
import numpy as np
import pandas as pd
import yaml
from bdf_caliper import Caliper
from caliper import Mesh, mesh_geometry
from small_decks import read_mesh

from squeal.deck.importer import import_deck

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")
MPIEXEC = sys.argv.pop(1) if len(sys.argv) > 1 else "mpirun -n"
COARSE = {"order": 1, "size": 1.5, "vanes": 12, "bolts": 0}
OPTIONS = repository / "options/floating_caliper.yaml"
WORDS = "-flutter_friction 0.3,0.6 -modes_count 80 -flutter_tolerance 1e-10 -report_fields off"


class FloatingCaliper(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)
        geometry = repository / "meshes/floating_caliper.geo"
        cls.options = yaml.safe_load(OPTIONS.read_text())
        mesh_geometry(geometry, cls.folder / "mesh.msh", **COARSE)
        cls.mesh = Mesh(cls.folder / "mesh.msh")
        (cls.folder / "brake.bdf").write_text(Caliper(cls.options, cls.mesh).deck(0.6))
        cls.journal = import_deck(cls.folder / "brake.bdf", cls.folder / "case", speed=5.0)
        cls.case = yaml.safe_load((cls.folder / "case/case.yaml").read_text())

    def eigenvalues(self, words, ranks):
        folder = self.folder / f"results_{ranks}"
        command = [*(MPIEXEC.split() + [str(ranks)] if ranks > 1 else []), PROGRAM]
        command += ["-options_file", *words, *WORDS.split(), "-checkpoint", "off"]
        command += ["-report_dir", folder]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        table = pd.read_csv(folder / "eigenvalues.csv")
        values = table.growth_rate_1_per_s + 1j * table.angular_frequency_rad_per_s
        return values.to_numpy(), int(table.unstable.sum())

    def test_bodies_and_surfaces_are_complete(self):
        groups, nodes, coordinates = read_mesh(self.folder / "case/mesh.msh")
        self.assertEqual(nodes.tolist(), sorted(self.mesh.places))
        for number, (_, cells) in enumerate(sorted(self.mesh.bodies.items()), 1):
            self.assertEqual(len(groups[f"psolid_{number}"]), len(cells))
        faces = sorted(len(rows) for name, rows in groups.items() if name.startswith("bcsurf"))
        used = {
            name
            for kind in ("contact", "tie")
            for one in self.options[kind].values()
            for key, name in one.items()
            if key in ("pad", "disc", "slave", "master")
        }
        self.assertEqual(faces, sorted(len(self.mesh.faces[name]) for name in used))
        wanted = np.array([self.mesh.places[at] for at in nodes.tolist()])
        self.assertLess(np.max(np.abs(coordinates - wanted)), 1e-14)

    def test_roles_motion_and_friction(self):
        roles = [one["role"] for one in self.case["contact"].values()]
        self.assertEqual(roles, [one["role"] for one in self.options["contact"].values()])
        (motion,) = self.case["motion"].values()
        self.assertEqual((motion["speed"], motion["axis"]), (5.0, "0.0,0.0,1.0"))
        self.assertEqual(self.case["flutter"]["friction"], 0.6)

    def test_all_eigenvalues_agree(self):
        wanted, unstable = self.eigenvalues([OPTIONS, "-mesh_file", self.folder / "mesh.msh"], 1)
        self.assertGreater(unstable, 0)
        for ranks in (1, 2):
            found, count = self.eigenvalues([self.folder / "case/case.yaml"], ranks)
            self.assertEqual((len(found), count), (len(wanted), unstable))
            difference = np.max(np.abs(found - wanted) / np.abs(wanted))
            print(f"{len(found)} eigenvalues, {ranks} ranks: difference {difference:.1e}")
            self.assertLess(difference, 1e-9)


if __name__ == "__main__":
    unittest.main()
