#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Runs over parts of one grid, and tests of their merge: grid_parts.py PROGRAM FOLDER makes the
runs. The tests of the merge derive from OnParts; their arguments are PROGRAM and FOLDER, and
without FOLDER they make the runs themselves."""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[3]
sys.path[:0] = [str(repository / "python")]
sys.dont_write_bytecode = True
import squeal
import squeal.merge

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")
MADE = sys.argv.pop(1) if len(sys.argv) > 1 else None
LAYERS = [
    "two_layers_moving",
    "-mesh_set",
    "nx=6,ny_disc=2,ny_pad=2,order=2",
    "-modes_count",
    "40",
    "-flutter_friction",
    "0,0.2,0.4",
    "-flutter_track",
    "on",
]
CHAIN = ["external_chain", "-flutter_sensitivities", "-flutter_friction"]
RUNS = {
    "layers": [*LAYERS, "-flutter_speed", "1,2"],
    "layers_1": LAYERS,
    "layers_2": [*LAYERS, "-flutter_speed", "2"],
    "chain": [*CHAIN, "0:1.2:0.2"],
    "chain_low": [*CHAIN, "0:1:0.2"],
    "chain_high": [*CHAIN, "1:1.2:0.2"],
    "chain_damped": [*CHAIN, "0:1.2:0.2", "-flutter_damping", "2"],
    "chain_band": [*CHAIN, "1.6", "-flutter_band", "0.5"],
}


def make(program, folder):
    """Makes the runs, each into the subfolder of its name."""
    for name, (case, *words) in RUNS.items():
        subprocess.run(
            [
                program,
                "-options_file",
                repository / f"options/{case}.yaml",
                "-report_dir",
                folder / name,
                "-quiet",
                *words,
            ],
            check=True,
            stdout=subprocess.DEVNULL,
        )


class OnParts(unittest.TestCase):
    """Merges of the runs into a folder of the test. No test changes the runs, only copies."""

    @classmethod
    def setUpClass(cls):
        if MADE is not None:
            cls.made = Path(MADE)
            return
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.made = Path(temporary.name)
        make(PROGRAM, cls.made)

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.out = self.folder / "out"

    def copy(self, name, **texts):
        """A copy of a run in which the texts of files, by their names with _ for the dot, are
        changed by functions."""
        copy = self.folder / f"{name}_{len(list(self.folder.iterdir()))}"
        shutil.copytree(self.made / name, copy, ignore=shutil.ignore_patterns("vtk"))
        for file, change in texts.items():
            path = copy / ".".join(file.rsplit("_", 1))
            before = path.read_text()
            path.write_text(change(before))
            self.assertNotEqual(path.read_text(), before)
        return copy

    def merge(self, *names, out=None):
        return squeal.merge.merge(out or self.out, [self.made / name for name in names])

    def refused(self, pattern, *names, call=None):
        with self.assertRaisesRegex(squeal.ResultsError, pattern) as caught:
            (call or self.merge)(*names)
        self.assertNotIn("\n", str(caught.exception))
        self.assertEqual([path.name for path in self.folder.glob(".*")], [])


if __name__ == "__main__":
    shutil.rmtree(MADE, ignore_errors=True)
    make(PROGRAM, Path(MADE))
