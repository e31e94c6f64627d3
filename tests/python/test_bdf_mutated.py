#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Damaged decks of Nastran: each is translated or refused in words, and translated ones lose
nothing.

With SQUEAL_LONG in the environment, 20,000 decks in place of 600.
"""
import os
import random
import re
import sys
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / one) for one in ("python", "tests/support/deck", "tests/support")]
sys.dont_write_bytecode = True
from damage import damaged, translated
from small_bdf import cube
from small_decks import read_mesh
from write_bdf import large, small

COUNT = 20000 if os.environ.get("SQUEAL_LONG") else 600
WORDS = (
    *("", "0", "-1", "1e400", "nan", "99999999999999999999", "1.5", "*", "+", "+A", "'", "=", ","),
    *("THRU", "UM", "ALPHA", "K", "GE", "\t", "\0", "é", "1,,", "-", "1.-3", "123456", "7", "$"),
    *("INCLUDE 'x'", "BEGIN BULK", "ENDDATA", "GRID", "CHEXA", "SPC", "LOAD = 3", "SUBCASE 4"),
)
CONTROL = """SOL 103
CEND
TITLE = a, b,
MPC = 40
SPC = 10
SUBCASE 1
 LOAD = 20
 DISP(PLOT,
 PRINT) = ALL
SUBCASE 2
 METHOD = 5
 STATSUB = 1
BEGIN BULK
"""
CARDS = (
    small("GRID", 11, 3, "1.", "30.", "2.", 3)
    + "GRID,12,,.5,.5,4.\nGRID,13,,.5,.5,4.\n"
    + large("CORD2C", 3, None, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0)
    + small("CTETRA", 2, 1, 5, 6, 8, 11, 0).rstrip().ljust(72)
    + "+T1\nPARAM,POST,-1\n+T1\n"
    + "RBE2,7,12,123456,5,6,7,8\nCONM2,3,12,,1.,.1\n,1.,,1.,,,1.\n"
    + "RBE3,8,,13,1234,1.,123,1,2,\n,3,2.,12,4\nPBUSH,4,K,1.,2.,3.\n,,B,.1\nCBUSH,9,4,12,13,,,,0\n"
    + "CELAS2,10,5.,11,2,7,1\nMPC,40,1,1,1.,2,1,-1.\nSPC1,10,3,11\nSPC,10,13,4,.1\n"
    + "FORCE,20,12,3,1.,1.,0.,0.\nPLOAD4,21,1,2.,,,,1,3\nGRAV,22,,9.81,0.,0.,-1.\n"
    + "LOAD,20,1.,1.,21,2.,22\nEIGRL,5,,,3\nMAT1,2,,80.,.25,1.\nPLOTEL,50,1,2\n"
)
SEED = cube(CARDS.replace("FORCE,20", "FORCE,21"), control=CONTROL)


def bulk(text):
    """Returns the first words of the lines of bulk data."""
    found, started = [], False
    for line in text.split("\n"):
        line = line.split("$")[0].rstrip() if "'" not in line else line.rstrip()
        word = line.split(",")[0][:8].strip().upper()
        if line.upper().split() == ["BEGIN", "BULK"]:
            started = True
        elif word.startswith("ENDDATA"):
            break
        elif started and line and word and word[0].isalpha():
            found.append(word.rstrip("*").strip())
    return found


class Damaged(unittest.TestCase):
    def test_the_seed_is_translated(self):
        self.assertEqual(translated(self, "deck.bdf", [SEED], self.complete), 1)

    def test_no_deck_is_lost_without_a_word(self):
        rng = random.Random(21)
        letters, times = "0123456789.,-*+= eEdD'\tAZ$", [1, 1, 1, 2, 3, 6]
        decks = (damaged(SEED, rng, times, WORDS, letters, inserted=" ,8") for _ in range(COUNT))
        # Enough of them must get as far as the mesh for the test to mean something.
        self.assertGreater(translated(self, "deck.bdf", decks, self.complete), COUNT // 20)

    def complete(self, text, journal, case):
        """Compares mesh and account with a count of the lines of the deck."""
        names = bulk(text)
        groups, nodes, _ = read_mesh(case / "mesh.msh")
        cells = {row for name, rows in groups.items() if name.startswith("psolid") for row in rows}
        self.assertEqual(len(cells), sum(name in ("CHEXA", "CTETRA") for name in names))
        self.assertEqual(len(nodes), len({node for row in cells for node in row}))
        counted = {}
        for source, entry in journal.entries.items():
            self.assertTrue(entry.status)
            words = [one for one in entry.remarks if one.endswith(" cards in sequence")]
            counted[source.card] = counted.get(source.card, 0) + int(
                (words or ["1 "])[0].split()[0]
            )
        for name in set(names):
            control = re.split(r"(?im)^\s*BEGIN", text)[0].upper()  # may have cards of this name
            extra = sum(name in line for line in control.split("\n"))
            self.assertGreaterEqual(counted.get(name, 0), names.count(name), name)
            self.assertLessEqual(counted.get(name, 0), names.count(name) + extra, name)


if __name__ == "__main__":
    unittest.main()
