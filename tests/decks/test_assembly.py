#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Assemblies, and decks of which cards are left out, through import and program:
test_assembly.py PROGRAM."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / one) for one in ("python", "tests/support/deck", "tests/decks")]
sys.dont_write_bytecode = True
import assembled
import numpy as np
from small_decks import cube
from solved import Solved

from squeal.deck.importer import import_deck
from squeal.report import build
from squeal.results import Results

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")


class Assemblies(unittest.TestCase):
    def test_an_assembly_is_the_same_as_its_flat_deck(self):
        text, files = assembled.assembly()
        one, other = Solved(PROGRAM, text, files), Solved(PROGRAM, assembled.flat())
        self.assertEqual(len(one.frequencies), 6)
        difference = np.max(np.abs(one.frequencies / other.frequencies - 1))
        self.assertLess(difference, 1e-9)
        nodes = other.tags > 0
        wanted = other.displacements[nodes]
        difference = np.max(np.abs(one.at(other.places[nodes]) - wanted)) / np.max(np.abs(wanted))
        self.assertLess(difference, 1e-9)
        difference = np.max(np.abs(one.references() - other.references()))
        self.assertLess(difference, 1e-9 * np.max(np.abs(other.references())))

    def test_results_name_what_the_import_has_left_out(self):
        names = ["GAP", "NMAP", "SHELL SECTION"]
        text = cube("".join(f"*{name}, ELSET=CUBE\n1., 2.\n" for name in names))
        text += "*STEP\n*FREQUENCY\n1\n*END STEP\n"
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "deck.inp").write_text(text)
            import_deck(Path(folder) / "deck.inp", Path(folder) / "case", ignored=names)
            command = [PROGRAM, "-options_file", "case/case.yaml", "-report_dir", "results"]
            run = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
            self.assertEqual(run.returncode, 0, run.stderr)
            note = "left out of deck.inp by --ignore: GAP, NMAP, SHELL SECTION"
            self.assertIn(f"Note: {note}\n", run.stdout)
            results = Results(Path(folder) / "results")
            self.assertEqual(results.summary["options"]["report_note"], note)
            self.assertIn(f"Note: {note}.", build(results))


if __name__ == "__main__":
    unittest.main()
