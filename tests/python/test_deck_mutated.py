#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Damaged decks: each is translated or refused in words, and translated ones lose nothing.

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
import assembled
import brake_of_cae
import many_cards
from damage import damaged, translated
from small_decks import cube, read_mesh

COUNT = 20000 if os.environ.get("SQUEAL_LONG") else 600
WORDS = (
    *("", "0", "-1", "1e400", "nan", "99999999999999999999", "1.5", "*", "**", '"', "=", ",,"),
    *("GENERATE", "*NSET, NSET=A", "*STEP", "*END STEP", "NLGEOM", "\t", "\0", "é", "1,,", "-"),
    *("I.1", "J.99", "*END PART", "*SYSTEM", "C3D20R", "SPRING1", "BEAM", "ENCASTRE", "1., 1., 1."),
    *("1-3", "S7", "P9", "GRAV", "TYPE=", "*INCLUDE, INPUT=x", "CUBE", "TOP", "*ELEMENT", "*NODE"),
)
LETTERS = '0123456789.,-*= eEdD"\tAZ'
JOINTS = """*NODE
20, 5., 0., 0.
21, 6., 0., 0.
*RIGID BODY, NSET=TOP, REF NODE=20, ROT NODE=21
*ELEMENT, TYPE=SPRINGA, ELSET=S
30, 1, 20
*SPRING, ELSET=S

10.
*TRANSFORM, NSET=BOTTOM, TYPE=C
-1., 0., 0., -1., 0., 1.
*NSET, NSET=PART, GENERATE
1, 3, 2
*NSET, NSET=MORE
PART, 4
*EQUATION
3
5, 1, 1., 6, 1, -0.5, 7, 1, -0.5
"""
LOADS = """*CLOAD
21, 2, 4.
MORE, 3, 1.
*DLOAD
CUBE, P2, 3.
CUBE, GRAV, 9.81, 0., 0., -1.
*NODE PRINT, NSET=TOP
U
"""
FREQUENCY = "*STEP, PERTURBATION\n*FREQUENCY\n4\n*END STEP\n"
SEED = cube(JOINTS, LOADS, FREQUENCY)


def one_file():
    """Returns the deck of an assembly with its included files in place of their cards."""
    text, files = assembled.assembly()
    for name, content in files.items():
        text = re.sub(rf"(?i)\*include, input={name}\n", lambda _: content, text)
    return text


SEEDS = (SEED, SEED, SEED, one_file(), brake_of_cae.TEXT)


def variants(rng, seeds, count):
    """Yields damaged decks."""
    for _ in range(count):
        yield damaged(rng.choice(seeds), rng, [1, 1, 2, 3, 6], WORDS, LETTERS)


def blocks(text):
    """Yields the keyword line of each card without blanks, and its fields that are not empty."""
    card, fields = "", []
    for line in text.split("\n"):
        line = line.strip()
        if line.startswith("*") and not line.startswith("**"):
            yield card, fields
            card, fields = line.upper().replace(" ", "").replace("\t", ""), []
        elif line and not line.startswith("**"):
            fields += [word for word in line.split(",") if word.strip()]
    yield card, fields


def name_of(card, parameter):
    words = [word for word in card.replace('"', "").split(",") if word.startswith(parameter)]
    return words[0][len(parameter) :] if words else ""


class Damaged(unittest.TestCase):
    def test_no_deck_is_lost_without_a_word(self):
        decks = variants(random.Random(20), SEEDS, COUNT)
        # Enough of them must get as far as the mesh for the test to mean something.
        self.assertGreater(translated(self, "deck.inp", decks, self.complete), COUNT // 20)

    def test_decks_with_many_cards(self):
        """Each ends with a case or in words."""
        rng, text = random.Random(21), many_cards.TEXT
        self.assertEqual(translated(self, "deck.inp", [text], lambda *_: None), 1)
        translated(self, "deck.inp", variants(rng, [text], COUNT // 4), lambda *_: None)

    def complete(self, text, journal, case):
        """Compares the mesh with a count of the fields of the deck."""
        cells = cards = 0
        parts, part = {}, None
        for card, fields in blocks(text):
            cards += bool(card)
            if card.startswith("*PART,"):
                part = name_of(card, "NAME=")
            elif card.startswith("*ENDPART"):
                part = None
            elif card.startswith("*ELEMENT,") and "TYPE=C3D8" in card:
                parts[part] = parts.get(part, 0) + len(fields) // 9
            elif card.startswith("*INSTANCE,"):
                cells += parts.get(name_of(card, "PART="), 0)
        cells += parts.get(None, 0)
        groups, nodes, _ = read_mesh(case / "mesh.msh")
        bodies = [
            rows for rows in groups.values() if isinstance(rows[0], tuple) and len(rows[0]) == 8
        ]
        self.assertEqual(sum(map(len, bodies)), cells)
        self.assertEqual(len(nodes), len({node for rows in bodies for row in rows for node in row}))
        self.assertEqual(len(journal.entries), cards)
        self.assertNotIn("", [entry.status for entry in journal.entries.values()])


if __name__ == "__main__":
    unittest.main()
