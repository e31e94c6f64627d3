#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""A floating caliper as an assembly deck, against the case that it was made from: test_caliper.py
PROGRAM [MPIEXEC]. All eigenvalues agree, on one rank and on two."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / one) for one in ("python", "tests/support/deck", "tests/decks")]
sys.dont_write_bytecode = True
import caliper
import numpy as np
import pandas as pd
import yaml
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
        caliper.mesh_geometry(
            repository / "meshes/floating_caliper.geo", cls.folder / "mesh.msh", **COARSE
        )
        cls.options = yaml.safe_load(OPTIONS.read_text())
        cls.mesh = caliper.Mesh(cls.folder / "mesh.msh")
        cls.case = cls.imported("case")

    @classmethod
    def imported(cls, name, **words):
        """Writes the deck and imports it into a folder; returns the options."""
        text, files = caliper.Caliper(cls.options, cls.mesh).deck(0.6, **words)
        (cls.folder / "Parts").mkdir(exist_ok=True)
        for file, content in {"brake.inp": text, **files}.items():
            (cls.folder / file).write_text(content)
        import_deck(cls.folder / "brake.inp", cls.folder / name)
        return yaml.safe_load((cls.folder / name / "case.yaml").read_text())

    def eigenvalues(self, words, ranks):
        """Returns the eigenvalues of a run and the number of unstable ones."""
        folder = Path(tempfile.mkdtemp(dir=self.folder))
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
        self.assertEqual(len(nodes), len(self.mesh.places))
        for name, cells in self.mesh.bodies.items():
            self.assertEqual(len(groups[f"{name}-1"]), len(cells))
        found = {name.split(".", 1)[1]: rows for name, rows in groups.items() if "." in name}
        for name, faces in self.mesh.faces.items():
            if name not in self.options["constraint"]:
                self.assertEqual(len(found[name]), len(faces), name)
        ordered = [
            places[np.lexsort(np.round(places, 9).T)]
            for places in (coordinates, np.array(list(self.mesh.places.values())))
        ]
        self.assertLess(np.max(np.abs(ordered[0] - ordered[1])), 1e-15)

    def test_roles_motion_and_friction(self):
        roles = [one["role"] for one in self.case["contact"].values()]
        self.assertEqual(roles, [one["role"] for one in self.options["contact"].values()])
        self.assertEqual(self.case["motion"]["disc-1"]["speed"], 5.0)
        self.assertEqual(self.case["flutter"]["friction"], "0.0:0.6:0.06")

    def test_all_eigenvalues_agree(self):
        wanted, unstable = self.eigenvalues([OPTIONS, "-mesh_file", self.folder / "mesh.msh"], 1)
        self.assertGreater(unstable, 0)
        divided = self.imported("divided", divided=("disc", "lining_inner", "caliper"))
        self.assertEqual(divided["material"]["disc-1"], {"sections": "disc-1.Lower,disc-1.Upper"})
        for case, ranks in (("case", 1), ("case", 2), ("divided", 2)):
            found, count = self.eigenvalues([self.folder / case / "case.yaml"], ranks)
            self.assertEqual((len(found), count), (len(wanted), unstable))
            difference = np.max(np.abs(found - wanted) / np.abs(wanted))
            print(f"{len(found)} eigenvalues, {case}, {ranks} ranks: difference {difference:.1e}")
            self.assertLess(difference, 1e-9)


if __name__ == "__main__":
    unittest.main()
