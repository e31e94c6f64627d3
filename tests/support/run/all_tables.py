#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Runs that write all tables: all_tables.py PROGRAM FOLDER makes them, except the run of
after_flutter.py. The tests of tables derive from OnTables; their arguments are PROGRAM, FOLDER and
RESULTS, the results of after_flutter.py. Without these folders they make the runs themselves."""
import csv
import io
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[3]
folders = ("python", "tests/support/run", "tests/support/steady")
sys.path[:0] = [str(repository / folder) for folder in folders]
sys.dont_write_bytecode = True
import after_flutter
import squeal
from pressed_block import pressed_block

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")
MADE = sys.argv.pop(1) if len(sys.argv) > 1 else None
AFTER_FLUTTER = sys.argv.pop(1) if len(sys.argv) > 1 else None
LAYERS = [
    "-mesh_set",
    "nx=4,ny_disc=2,ny_pad=2,order=2",
    "-modes_count",
    "30",
    "-report_fields",
    "off",
]
# Shipped cases on small meshes, and a block whose nodes open: all tables that there are.
RUNS = {
    "layers": [
        "-options_file",
        repository / "options/two_layers_moving.yaml",
        *LAYERS,
        "-flutter_friction",
        "0,0.2,0.4",
        "-flutter_track",
        "on",
        "-flutter_sensitivities",
        "-report_component_modes",
        "2",
    ],
    "chain": ["-options_file", repository / "options/external_chain.yaml"],
    "judged": [
        "-options_file",
        repository / "options/external_chain.yaml",
        "-flutter_friction",
        "0.2",
        "-referee_list",
        repository / "tests/support/problem/chain_list.txt",
    ],
    "belt": ["-options_file", repository / "options/external.yaml"],
    "layer": [
        "-options_file",
        repository / "options/layer.yaml",
        "-report_fields",
        "off",
        "-modes_count",
        "20",
    ],
    "opening": [
        *pressed_block("nx=8,ny=8", modes=20, frictions="0:0.5:0.1"),
        "-flutter_proof",
    ],
}


def make(program, folder):
    """Makes the runs, each into the subfolder of its name."""
    for name, words in RUNS.items():
        subprocess.run(
            [program, *words, "-report_dir", folder / name, "-quiet"],
            check=True,
            stdout=subprocess.DEVNULL,
        )


def cells_of(text):
    return list(csv.reader(io.StringIO(text)))


def text_of(rows):
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows(rows)
    return out.getvalue()


class OnTables(unittest.TestCase):
    """Results that a test may damage: copies of the runs."""

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.place = Path(temporary.name) / "runs"
        if MADE is None:
            make(PROGRAM, cls.place)
        else:
            shutil.copytree(MADE, cls.place)
        after_flutter.RUN.place(PROGRAM, AFTER_FLUTTER, cls.place / "brake")
        cls.runs = {name: squeal.open(cls.place / name) for name in ("brake", *RUNS)}


if __name__ == "__main__":
    shutil.rmtree(MADE, ignore_errors=True)
    make(PROGRAM, Path(MADE))
