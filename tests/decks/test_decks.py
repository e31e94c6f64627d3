#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Decks of CalculiX's test suite, solved by CalculiX and by this program: test_decks.py PROGRAM.

The decks come from Debian's package calculix-ccx-test and are never copied; without it, or without
calculix-ccx, the test is skipped (exit code 77).
"""
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(Path(__file__).resolve().parent)]
sys.dont_write_bytecode = True
import bars
import ccx
import numpy as np
from comparison import Comparison

from squeal.deck.importer import import_deck
from squeal.deck.journal import DeckError

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")
# CalculiX prints seven digits. It integrates the mass of C3D10 and C3D15 with fewer points.
DIGITS, COARSE = 1e-6, 1e-3
DECKS = (
    *("beam20p", "beam10p", "beam8p", "beam8f", "beamf", "beamd", "achtelp", "achtelg", "achtelc"),
    *("achtel2", "achtelcas", "beamidset", "beampset", "beamp2stage", "beampo1", "beampo2"),
    *("c3d15", "beamptied1", "beamprb", "distcoup", "segment1", "segmentf", "mpcforce", "spring3"),
    "dashpot1",
)
BOUNDS = {"beam10p": COARSE, "c3d15": COARSE}
# Those with C3D20R that are solved as they are. Two kinds are left out: free vibrations, as
# CalculiX also reduces the mass, and segment1, whose curved cells it loads with fewer points.
REDUCED = (
    *("beamd", "achtelp", "achtelg", "achtelc", "achtel2", "achtelcas", "beamidset", "beampset"),
    *("beamp2stage", "beampo1", "beampo2", "beamptied1", "beamprb", "distcoup", "segmentf"),
    "mpcforce",
)
# More decks of the package that are translated.
OTHERS = (
    *("achtel29", "achtel9", "achteld", "aniso", "beamnlmpc", "beamp", "beamp1rotate", "beamrb"),
    *("beampdepmpc", "beamptied2", "beamrb2", "disk2", "segment2", "segmentm"),
)
# Here equations join supported nodes, whose forces CalculiX prints together with the reactions.
WITHOUT_REACTIONS = {"disk2", "segmentm"}
IGNORED = {"dashpot1": ["MODAL DYNAMIC"]}
# Those with cards that Abaqus reads differently, and without a word that it does not know.
AMBIGUOUS = {"distcoup", "tie of nodes, some of them too far away"}
# Cards, parameters, element types and labels that each error has to name.
REFUSED = {
    "beamnlp": {"NLGEOM"},
    "beamrb": {"NLGEOM"},
    "beamt": {"TEMPERATURE"},
    "beamog": {"HYPERELASTIC", "NLGEOM"},
    "beampik": {"PLASTIC", "CYCLIC HARDENING", "NLGEOM"},
    "beamb": {"BUCKLE"},
    "shell1": {"S8R", "SHELL SECTION", "NODAL THICKNESS", "TEMPERATURE", "NLGEOM"},
    "cubenewt": {"INITIAL CONDITIONS", "DYNAMIC", "NEWTON"},
    "rotor": {"NLGEOM", "COMPLEX FREQUENCY"},
    "changesolidsection": {"CHANGE SOLID SECTION"},
    "gap": {"GAPUNI", "GAP", "NLGEOM"},
}


class Decks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)
        cls.rows = []

    @classmethod
    def tearDownClass(cls):
        print(f"{'deck':41} {'quantity':10} {'difference':>10} {'bound':>8}  passed")
        for deck, quantity, difference, bound in cls.rows:
            passed = "yes" if difference <= bound else "NO"
            print(f"{deck:41} {quantity:10} {difference:10.1e} {bound:8.1e}  {passed}")

    def compare(self, deck, full):
        name = deck if full else f"{deck} as it is"
        text = ccx.comparable(ccx.deck_text(deck), full)
        words = IGNORED.get(deck, ()), "calculix" if deck in AMBIGUOUS else None
        one = Comparison(PROGRAM, text, self.folder / name, *words)
        self.measure(name, one, BOUNDS.get(deck, DIGITS), deck not in WITHOUT_REACTIONS)

    def measure(self, name, one, bound, reactions):
        measured = []
        if one.reference.displacements:
            measured.append(("U", one.displacements()))
            if reactions:
                measured += zip(("RF", "moment"), one.reactions())
        if len(one.reference.frequencies):
            measured.append(("Hz", one.frequencies()))
        self.assertTrue(measured)
        for quantity, difference in measured:
            self.rows.append((name, quantity, difference, bound))
            self.assertLessEqual(difference, bound, f"{name}: {quantity}")

    def test_results_agree(self):
        for deck in DECKS + OTHERS:
            with self.subTest(deck):
                self.compare(deck, full=True)

    def test_results_agree_with_reduced_integration(self):
        for deck in REDUCED:
            with self.subTest(deck):
                self.compare(deck, full=False)

    def test_contact_is_the_limit_of_stiff_penalties(self):
        """The error of a penalty k is a/k + b/k²; two penalties eliminate the first term."""
        text = ccx.comparable(ccx.deck_text("contact4"), True)
        limit = 0.0
        for penalty, factor in (("1.E7", 0), ("1.E8", -1 / 9), ("1.E9", 10 / 9)):
            one = Comparison(PROGRAM, text.replace("1.E7", penalty), self.folder / penalty)
            ours, theirs = one.both_displacements()
            limit = limit + factor * theirs
            self.near(f"contact4, penalty {penalty}", ours, theirs, 4e5 / float(penalty))
        # CalculiX iterates until forces change by 0.5 %, which limits its accuracy.
        self.near("contact4, limit of penalties", ours, limit, 5e-5)

    def test_soft_penalties_are_layers(self):
        """They change the displacements by 73 % and 23 %; the accuracy is that of CalculiX, which
        iterates until forces change by 0.5 %."""
        text = ccx.comparable(ccx.deck_text("contact4"), True)
        for penalty in ("1.E5", "1.E6"):
            one = Comparison(PROGRAM, text.replace("1.E7", penalty), self.folder / penalty)
            ours, theirs = one.both_displacements()
            self.near(f"contact4, layer {penalty}", ours, theirs, 2e-4)

    def near(self, name, ours, theirs, bound):
        difference = float(np.max(np.abs(ours - theirs)) / np.max(np.abs(theirs)))
        self.rows.append((name, "U", difference, bound))
        self.assertLessEqual(difference, bound, name)

    def test_results_of_own_decks_agree(self):
        for name, text in bars.DECKS.items():
            with self.subTest(name):
                folder = self.folder / name.replace(" ", "_")
                dialect = "calculix" if name in AMBIGUOUS else None
                one = Comparison(PROGRAM, text, folder, dialect=dialect)
                self.measure(name, one, DIGITS, True)

    def test_refused_decks_name_all_unsupported_cards(self):
        for deck, names in REFUSED.items():
            with self.subTest(deck):
                path = self.folder / f"{deck}.inp"
                path.write_text(ccx.deck_text(deck), encoding="latin-1")
                with self.assertRaises(DeckError) as raised:
                    import_deck(path, self.folder / f"{deck}_case")
                lines = path.read_text(encoding="latin-1").upper().splitlines()
                for row in str(raised.exception).splitlines()[1:]:
                    if row.strip().startswith("the model:"):
                        continue
                    # FILE:LINE: *CARD, NAME: reason
                    place, card, reason = row.strip().split(": ", 2)
                    number = int(place.rsplit(":", 1)[1])
                    self.assertTrue(reason)
                    named = {word.strip().lstrip("*") for word in card.split(",")} & names
                    names = names - named
                    if named:
                        text = lines[number - 1]
                        self.assertTrue(any(name in text for name in named), (row, text))
                self.assertFalse(names, f"{deck}: not named: {names}\n{raised.exception}")
                self.assertEqual(
                    [one.name for one in (self.folder / f"{deck}_case").iterdir()], ["import.md"]
                )


if __name__ == "__main__":
    if shutil.which("ccx") is None or not ccx.FOLDER.is_dir():
        print("skipped: the packages calculix-ccx and calculix-ccx-test are not installed")
        sys.exit(77)
    unittest.main()
