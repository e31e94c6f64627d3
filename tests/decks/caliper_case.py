# SPDX-License-Identifier: BSD-2-Clause
"""The floating caliper, coarse, as the case that decks of it are compared with."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import caliper
import numpy as np
import pandas as pd
import yaml

repository = Path(__file__).resolve().parents[2]
PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")
MPIEXEC = sys.argv.pop(1) if len(sys.argv) > 1 else "mpirun -n"
COARSE = {"order": 1, "size": 1.5, "vanes": 12, "bolts": 0}
OPTIONS = repository / "options/floating_caliper.yaml"
WORDS = "-flutter_friction 0.3,0.6 -modes_count 80 -flutter_tolerance 1e-10 -report_fields off"


class CaliperCase(unittest.TestCase):
    """`options` and `mesh` of the case, whose mesh.msh is in `folder`."""

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)
        geometry = repository / "meshes/floating_caliper.geo"
        caliper.mesh_geometry(geometry, cls.folder / "mesh.msh", **COARSE)
        cls.options = yaml.safe_load(OPTIONS.read_text())
        cls.mesh = caliper.Mesh(cls.folder / "mesh.msh")

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

    def agree(self, cases):
        """Compares the eigenvalues of imported cases, (folder, ranks), with those of the case."""
        wanted, unstable = self.eigenvalues([OPTIONS, "-mesh_file", self.folder / "mesh.msh"], 1)
        self.assertGreater(unstable, 0)
        for case, ranks in cases:
            found, count = self.eigenvalues([self.folder / case / "case.yaml"], ranks)
            self.assertEqual((len(found), count), (len(wanted), unstable))
            difference = np.max(np.abs(found - wanted) / np.abs(wanted))
            print(f"{len(found)} eigenvalues, {case}, {ranks} ranks: difference {difference:.1e}")
            self.assertLess(difference, 1e-9)
