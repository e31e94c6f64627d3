#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Contact of decks: hard pairs, soft layers, and pairs that are refused."""
import sys
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/deck")]
sys.dont_write_bytecode = True
from small_decks import Imported, cube, refused


class Contacts(unittest.TestCase):
    BLOCK = "*NODE\n11, 0., 0., 1.\n12, 1., 0., 1.\n13, 1., 1., 1.\n14, 0., 1., 1.\n"
    BLOCK += "21, 0., 0., 2.\n22, 1., 0., 2.\n23, 1., 1., 2.\n24, 0., 1., 2.\n"
    BLOCK += "*ELEMENT, TYPE=C3D8, ELSET=CUBE\n2, 11, 12, 13, 14, 21, 22, 23, 24\n"
    BLOCK += "*SURFACE, NAME=UP\n1, S2\n*SURFACE, NAME=DOWN\n2, S1\n"
    PAIR = "*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE\nDOWN, UP\n"
    PAIR += "*SURFACE INTERACTION, NAME=I\n"

    def test_hard_contact(self):
        behaviors = ("", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1.E7, 1.\n")
        for behavior in behaviors:
            one = Imported(cube(self.BLOCK + self.PAIR + behavior))
            (options,) = one.options["contact"].values()
            wanted = {"pad": "DOWN", "disc": "UP", "slave": "pad", "gap": "measured"}
            self.assertEqual(options, {**wanted, "role": "frictionless"})
            self.assertEqual(sorted(one.groups["DOWN"][0]), [11, 12, 13, 14])
            self.assertTrue(any("contact is hard" in text for text in one.journal.choices))

    def test_soft_penalties_are_layers(self):
        linear = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1.E6\n"
        one = Imported(cube(self.BLOCK + self.PAIR + linear))
        (options,) = one.options["contact"].values()
        self.assertEqual(float(options["stiffness"]), 1e6)
        self.assertTrue(any("4.76 times as stiff" in text for text in one.journal.choices))

    def test_contacts_that_are_refused(self):
        linear = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1.E6\n"
        spare = "*SURFACE INTERACTION, NAME=J\n*FRICTION\n0.3, 5000.\n"
        one = Imported(cube(self.BLOCK + self.PAIR + spare), dialect="calculix")
        self.assertEqual(one.remarks("FRICTION")[0], "not used")
        rows = refused(cube(self.BLOCK + self.PAIR + linear.replace("LINEAR", "TIED")))
        self.assertIn("PRESSURE-OVERCLOSURE=TIED is not supported", rows[0])
        rows = refused(cube(self.BLOCK + self.PAIR.replace("PAIR,", "PAIR, ADJUST=TOP,")))
        self.assertIn("*CONTACT PAIR, ADJUST", rows[0])


if __name__ == "__main__":
    unittest.main()
