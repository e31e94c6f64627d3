#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Assemblies, and decks of which cards are left out, through import and program:
test_assembly.py PROGRAM."""
import re
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
from pin_on_plate import box
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


class Ties(unittest.TestCase):
    def test_tied_nodes_are_those_of_the_program(self):
        """Three by three cells over four by four, of which the last row overhangs in part or as a
        whole."""
        for shift, tied in ((0.5, 16), (1.5, 16), (2.5, 12), (2.95, 8), (2.0, 12)):
            lower_nodes, lower, place = box((4, 4, 1), (0, 0, 0), 1, 1)
            upper_nodes, upper, _ = box((3, 3, 1), (shift, 0.5, 1), 101, 101)
            lines = ["*NODE", *lower_nodes, *upper_nodes, "*NSET, NSET=BASE"]
            lines += map(str, place[:, :, 0].ravel())
            for name, cells, face in (("LOW", lower, 2), ("UP", upper, 1)):
                lines += [f"*ELEMENT, TYPE=C3D8, ELSET={name}", *cells]
                lines += [f"*SURFACE, NAME={name}_FACE", f"{name}, S{face}"]
                lines.append(f"*SOLID SECTION, ELSET={name}, MATERIAL=M")
            lines += ["*MATERIAL, NAME=M", "*ELASTIC", "1000., 0.3", "*DENSITY", "1."]
            lines += ["*TIE, NAME=T", "UP_FACE, LOW_FACE", "*BOUNDARY", "BASE, 1, 3"]
            lines += ["*STEP", "*FREQUENCY", "1", "*END STEP", ""]
            with tempfile.TemporaryDirectory() as folder:
                (Path(folder) / "deck.inp").write_text("\n".join(lines))
                import_deck(Path(folder) / "deck.inp", Path(folder) / "case")
                account = (Path(folder) / "case/import.md").read_text()
                self.assertIn(f"| T | faces | {tied} | {16 - tied} |\n", account)
                command = [PROGRAM, "-options_file", "case/case.yaml", "-report_dir", "results"]
                run = subprocess.run(
                    command, cwd=folder, capture_output=True, text=True, check=False
                )
                found = re.search(
                    r"tie 'T' tied: (\d+) nodes .*tied, (\d+) nodes are not", run.stdout
                )
                self.assertEqual(found.groups(), (str(tied), str(16 - tied)), run.stdout)


if __name__ == "__main__":
    unittest.main()
