#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Assemblies through import and program: test_assembly.py PROGRAM."""
import sys
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / one) for one in ("python", "tests/support/deck", "tests/decks")]
sys.dont_write_bytecode = True
import assembled
import numpy as np
from solved import Solved

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


if __name__ == "__main__":
    unittest.main()
