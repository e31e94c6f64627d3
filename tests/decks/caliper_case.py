# SPDX-License-Identifier: BSD-2-Clause
"""The floating caliper, coarse, or at full size with FULL as the last word of the command line, as
the case that decks of it are compared with."""
import json
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
FULL = sys.argv[-1] == "FULL" and bool(sys.argv.pop())
PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")
MPIEXEC = sys.argv.pop(1) if len(sys.argv) > 1 else "mpirun -n"
GEOMETRY = {} if FULL else {"order": 1, "size": 1.5, "vanes": 12, "bolts": 0}
OPTIONS = repository / "options/floating_caliper.yaml"
WORDS = "-flutter_friction 0.3,0.6 -modes_count 80 -flutter_tolerance 1e-10 -report_fields off"


class CaliperCase(unittest.TestCase):
    """`options` and `mesh` of the case, whose mesh.msh is in `folder`; its eigenvalues `wanted`,
    the number of `unstable` ones, and `slaves`: interface -> "pad" or "disc", the side that the
    program takes as the slave, which a deck has first."""

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)
        geometry = repository / "meshes/floating_caliper.geo"
        caliper.mesh_geometry(geometry, cls.folder / "mesh.msh", **GEOMETRY)
        cls.options = yaml.safe_load(OPTIONS.read_text())
        cls.mesh = caliper.Mesh(cls.folder / "mesh.msh")
        words = [OPTIONS, "-mesh_file", cls.folder / "mesh.msh"]
        cls.wanted, cls.unstable, summary = cls.solved(words, 1)
        cls.slaves = {
            name: summary["interfaces"][f"interface '{name}'"]["slave_is"]
            for name in cls.options["contact"]
        }

    @classmethod
    def solved(cls, words, ranks):
        """Returns the eigenvalues of a run, the number of unstable ones, and summary.json."""
        folder = Path(tempfile.mkdtemp(dir=cls.folder))
        command = [*(MPIEXEC.split() + [str(ranks)] if ranks > 1 else []), PROGRAM]
        command += ["-options_file", *words, *WORDS.split(), "-checkpoint", "off"]
        command += ["-report_dir", folder]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        if run.returncode != 0:
            raise RuntimeError(run.stdout + run.stderr)
        table = pd.read_csv(folder / "eigenvalues.csv")
        values = table.growth_rate_1_per_s + 1j * table.angular_frequency_rad_per_s
        summary = json.loads((folder / "summary.json").read_text())
        return values.to_numpy(), int(table.unstable.sum()), summary

    def agree(self, cases):
        """Compares the eigenvalues of imported cases, (folder, ranks), with those of the case."""
        self.assertGreater(self.unstable, 0)
        for case, ranks in cases:
            found, count, _ = self.solved([self.folder / case / "case.yaml"], ranks)
            self.assertEqual((len(found), count), (len(self.wanted), self.unstable))
            difference = np.max(np.abs(found - self.wanted) / np.abs(self.wanted))
            print(f"{len(found)} eigenvalues, {case}, {ranks} ranks: difference {difference:.1e}")
            self.assertLess(difference, 1e-9)
