# SPDX-License-Identifier: BSD-2-Clause
"""squeal-run with a deck: its words for the import. Call: test_run_deck.py."""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "tests/support/deck")]
sys.dont_write_bytecode = True
from small_decks import cube

DAMPED = cube().replace("*DENSITY", "*DAMPING, ALPHA=2., BETA=0.\n*DENSITY")
DECK = DAMPED.replace("*STEP\n", "*STEP, NLGEOM\n")


class Decks(unittest.TestCase):
    def run_deck(self, name, *words):
        """Returns exit code, output, and the case that was written, if any."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / name
            path.write_text(DECK)
            command = [ROOT / "scripts/squeal-run", path, "-dry_run", *words]
            environment = dict(os.environ, NP="1")
            run = subprocess.run(
                command, env=environment, capture_output=True, text=True, check=False
            )
            case = path.with_suffix("") / "case.yaml"
            written = case.read_text() if case.is_file() else ""
        return run.returncode, run.stdout + run.stderr, written

    def test_words_for_the_import(self):
        code, printed, _ = self.run_deck("cube.inp")
        self.assertEqual(code, 1)
        self.assertIn("choose --dialect abaqus or calculix", printed)
        self.assertIn("*STEP, NLGEOM", printed)
        for words in (
            ("--dialect", "abaqus", "--ignore", "NLGEOM"),
            ("--ignore=NLGEOM", "-quiet", "--dialect=abaqus"),
        ):
            code, printed, case = self.run_deck("cube.inp", *words)
            self.assertEqual(code, 0, printed)
            self.assertIn("rayleigh_mass: 2.0", case)
            self.assertIn("by --ignore: NLGEOM", case)
        for words, reason in (
            (("--speed", "-0"), "--speed -0: the speed of a motion is positive"),
            (("--subcase", "2"), "--subcase is for decks of Nastran"),
            (("--ignore",), "expected one argument"),
        ):
            code, printed, _ = self.run_deck("cube.inp", *words)
            self.assertNotEqual(code, 0)
            self.assertIn(reason, printed)

    def test_a_case_has_no_such_words(self):
        code, printed, _ = self.run_deck("cube.yaml", "--speed", "3")
        self.assertEqual(code, 1)
        self.assertIn("squeal-run: --speed is for decks", printed)

    def test_the_help_names_them(self):
        for command in ("run", "squeal-run"):
            run = subprocess.run(
                [ROOT / "scripts" / command, "--help"], capture_output=True, text=True, check=True
            )
            self.assertIn("--dialect, --ignore, --speed and --subcase", run.stdout)


if __name__ == "__main__":
    unittest.main()
