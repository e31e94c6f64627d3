#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The language of Nastran decks: fields, continuations, files, executive and case control."""
import sys
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/deck")]
sys.dont_write_bytecode = True
from small_bdf import CONTROL, CUBE, HELD, STEEL, cube, force, imported, refusals

WANTED = imported(cube(force())).options
SMALL = "CHEXA,1,1,1,2,3,4,5,6,\n,7,8\n"
GRID = "GRID,7,,1.,1.,1.\n"


def small(*fields):
    """Returns a line of small fields."""
    return "".join(f"{field:<8}" for field in fields).rstrip() + "\n"


def large(*fields):
    return f"{fields[0]:<8}" + "".join(f"{field:>16}" for field in fields[1:]) + "\n"


class Fields(unittest.TestCase):
    def same(self, *replacements, text=None):
        text = text or cube(force())
        for old, new in replacements:
            self.assertIn(old, text)
            text = text.replace(old, new)
        one = imported(text)
        self.assertEqual(one.options, WANTED)
        return one

    def test_small_large_and_free_fields(self):
        chexa = small("CHEXA", 1, 1, 1, 2, 3, 4, 5, 6)
        self.same((SMALL, chexa + small("", 7, 8)))
        self.same((GRID, small("GRID", 7, "", "1.", "1.", "1.")))
        self.same((GRID, large("GRID*", 7, "", "1.", "1.") + large("*", "1.")))
        self.same((GRID, "GRID*,7,,1.,1.,\n*,1.\n"), (SMALL, "CHEXA ,1, 1 ,1,2,3,4,5,6\n+,7,8\n"))
        # Real numbers may fill their fields, without a blank between them.
        self.same((GRID, "GRID           7        1.000000+1.00000+1.00000\n"))

    def test_fields_of_large_lines_before_a_small_one(self):
        record = large("CHEXA*", 1, 1, 1, 2) + large("*", 3, 4, 5, 6) + small("+", 7, 8)
        self.same((SMALL, record))
        record = large("MAT1*", 1, "210000.", "", 0.3) + large("*", "7.8-9") + small("+", 1.0)
        self.same(("MAT1,1,210000.,,0.3,7.8-9\n", record))

    def test_tabs_line_ends_lower_case_and_comments(self):
        self.same((GRID, "GRID\t7\t\t1.\t1.\t1.\n"))
        text = cube(force())
        for changed in (
            text.replace("\n", "\r\n"),
            text.replace("\n", "\r"),
            text.lower(),
            "$ comment\n\n   $ comment\n" + text.replace("\n", " $ comment, with commas\n"),
            text.replace(",2.,", ", 2. ,"),
        ):
            self.assertEqual(imported(changed).options, WANTED)

    def test_exponents_without_a_letter(self):
        for text, value in (("1.-3", 1e-3), ("1.+2", 100.0), ("+1.", 1.0), ("2.1D5", 2.1e5)):
            one = imported(cube(force()).replace("210000.", text))
            self.assertEqual(one.options["material"]["psolid_1"]["young"], value)
        self.assertEqual(
            list(imported(cube(force()).replace("1.,1.,1.", "+1.5,+1.,1.")).coordinates[6]),
            [1.5, 1, 1],
        )

    def test_numbers_that_are_none(self):
        for text in ("1.2.3", "1,5", "x", "nan", "1_0.", "1 0", "0x1", "1.+-2", "inf"):
            rows = refusals(cube(force()).replace(GRID, f"GRID,7,,{text},1.,1.\n"))
            self.assertTrue(any("deck.bdf:12: GRID" in row for row in rows) or text == "1,5", rows)

    def test_free_fields_without_a_place_are_refused(self):
        rows = refusals(cube(force()).replace(GRID, "GRID,7,,1.,1.,1.,,,,,5\n"))
        self.assertIn("deck.bdf:12: GRID: a free-field line has at most 10 fields", rows[0])
        (row,) = refusals(cube(force() + "SPC1,10,3,5,6,7,8,,,+A,9\n"))
        self.assertIn("at most 10 fields", row)

        rows = refusals(cube(force() + "SPC1,10,3,5,6,7,8,1,2,3\n"))
        self.assertIn("'3' in field 10 does not begin with", rows[0])

    def test_columns_after_80_are_named(self):
        line = small("GRID", 7, "", "1.", "1.", "1.").rstrip().ljust(80) + "checked\n"
        one = self.same((GRID, line))
        self.assertTrue(
            any("deck.bdf:12: columns after 80" in text for text in one.journal.choices)
        )

    def test_fields_that_nothing_reads_are_refused(self):
        for card, field in (
            ("GRID,9,,1.,1.,1.,,,,\n,5\n", "GRID: field 2 of line 2, '5'"),
            ("FORCE,20,5,,1.,0.,0.,1.,4\n", "FORCE: field 9, '4'"),
            ("PDAMP,1,2.,,,,,,,\n,3.\n", "PDAMP: field 2 of line 2, '3.'"),
            ("SPC,10,5,1,0.,6,2,,7\n", "SPC: field 9, '7'"),
        ):
            (row,) = refusals(cube(force() + card))
            self.assertIn(field, row)


class Continuations(unittest.TestCase):
    def wanted(self, *lines, choice=None):
        one = imported(cube(force()).replace(SMALL, "".join(lines)))
        self.assertEqual(one.options, WANTED)
        self.assertEqual(one.groups["psolid_1"], [tuple(range(1, 9))])
        if choice:
            self.assertTrue(any(choice in text for text in one.journal.choices))

    def test_markers_of_every_style(self):
        card = ("CHEXA", 1, 1, 1, 2, 3, 4, 5, 6)
        for end, start in (
            *(("", ""), ("+", "+"), ("+C1", "+C1"), ("+C1", ""), ("", "+"), ("+000001", "+000001")),
            *(("XC1", "+C1"), ("*C1", "*C1"), ("*", "*"), ("+C1", "+")),
        ):
            line = large(start, 7, 8) if start.startswith("*") else small(start, 7, 8)
            self.wanted(small(*card, end), line)

    def test_a_marked_line_after_a_card_without_a_marker(self):
        self.wanted(small("CHEXA", 1, 1, 1, 2, 3, 4, 5, 6), small("+C1", 7, 8), choice="no marker")

    def test_lines_far_from_their_card(self):
        """A continuation is found by its marker, and its own continuation follows it."""
        card = small("CHEXA", 1, 1, 1, 2, 3, 4, 5, 6, "+C1")
        text = cube(force()).replace(SMALL, card)
        for place in ("PSOLID", "GRID,3", "ENDDATA"):
            moved = text.replace(place, small("+C1", 7, 8) + place)
            one = imported(moved)
            self.assertEqual(one.options, WANTED)
            self.assertEqual(one.groups["psolid_1"], [tuple(range(1, 9))])
        spc = "SPC1,10,123,1,2,,,,,+A\n" + GRID.replace("7", "9") + "+B,4\n+A,3,,,,,,,,+B\n"
        one = imported(cube(force(), held=spc))
        self.assertEqual(one.groups["spc_10"], [1, 2, 3, 4])

    def test_markers_are_never_data(self):
        """`+000001` at both ends is not grid 1."""
        spc = small("SPC1", 10, 123, 3, 4, 5, 6, 7, 8, "+000001") + small("+000001", 2)
        one = imported(cube(force(), held=spc))
        self.assertEqual(one.groups["spc_10"], [2, 3, 4, 5, 6, 7, 8])

    def test_continuations_belong_to_the_card_before_them(self):
        """Also to one that is not translated; the element after it keeps its nodes."""
        beam = small("CBAR", 9, 9, 1, 2, 0.0, 0.0, "1.", "", "+CB") + small("+CB", "", 5)
        (row,) = refusals(cube(force() + beam))
        self.assertIn("CBAR: beams are not supported", row)
        one = imported(cube(force() + beam), ignored=["CBAR"])
        self.assertEqual(one.groups["psolid_1"], [tuple(range(1, 9))])

    def test_lines_after_a_comma(self):
        lines = "CHEXA,1,1,1,2,3,4,5,6,\n", "7,8\n"
        self.wanted(*lines, choice="continues the line before it, which ends with a comma")

    def test_lines_without_a_card(self):
        text = cube(force())
        (row,) = refusals(text.replace("GRID,1,", "+A,5\nGRID,1,", 1))
        self.assertIn("whose marker A no card has", row)
        (row,) = refusals(text.replace("BEGIN BULK\n", "BEGIN BULK\n,5\n", 1))
        self.assertIn("a continuation, without a card", row)
        (row,) = refusals(text.replace(GRID, GRID + "=,*(1),=,*(1.),==\n"))
        self.assertIn("replicated cards is not supported", row)
        (row,) = refusals(text.replace(GRID, GRID + "12,3,4\n"))
        self.assertIn("a card without a name", row)


class Order(unittest.TestCase):
    def test_cards_may_stand_in_any_order(self):
        lines = (CUBE.replace(SMALL, "") + STEEL + HELD + force()).splitlines(keepends=True)
        one = imported(CONTROL + SMALL + "".join(reversed(lines)))
        self.assertEqual(one.options, WANTED)

    def test_cards_that_are_known_but_not_used(self):
        one = imported(cube(force() + "PLOTEL,5,1,2\nPLOTEL,6,2,3\nPSHELL,4,1,2.\nPARAM,POST,-1\n"))
        self.assertEqual(one.options, WANTED)
        self.assertEqual(one.remarks("PLOTEL"), ("not used", "2 cards in sequence; lines of plots"))
        self.assertEqual(one.remarks("PSHELL")[0], "not used")
        self.assertEqual(one.remarks("PARAM")[0], "not used")

    def test_everything_else_is_refused_at_once(self):
        names = "CQUAD4 CTRIA3 CBAR CBEAM CROD CONM1 CELAS3 CGAP RBE1 RSPLINE MAT8 MAT2 MATS1 MATHP"
        names += " PLOAD PLOAD2 DLOAD SPOINT CMASS2 GENEL DMIG CFAST CWELD ACCEL NSM BOLT XYZ DTI"
        names = names.split()
        text = cube(force() + "".join(f"{name},20,2,3\n" for name in names))
        rows = refusals(text)
        self.assertEqual([row.split(": ")[1] for row in rows], names)
        lines = text.splitlines()
        for row, name in zip(rows, names):
            self.assertTrue(lines[int(row.split(":")[1]) - 1].startswith(name + ","))
        one = imported(text, ignored=names)
        note = one.options.pop("report")["note"]
        self.assertEqual(note, f"left out of deck.bdf by --ignore: {', '.join(names)}")
        self.assertEqual(one.options, WANTED)
        self.assertEqual(one.account.count("ignored by --ignore"), len(names))

    def test_loads_of_other_sets(self):
        one = imported(cube(force() + "PLOAD2,21,3.,1\nACCEL1,22,,1.,0.,0.,1.\n"))
        self.assertEqual(one.options, WANTED)
        self.assertEqual(one.remarks("PLOAD2"), ("not used", "its set is not selected"))
        (row,) = refusals(cube(force() + "PLOAD2,20,3.,1\n"))
        self.assertIn("PLOAD2: pressures on shells", row)

    def test_temperatures(self):
        one = imported(cube(force() + "TEMPD,9,20.\n"))
        self.assertEqual(one.remarks("TEMPD")[0], "not used")
        (row,) = refusals(cube(force() + "TEMPD,9,20.\n", control=""))
        self.assertIn("TEMPD: temperatures and their strains", row)


class Files(unittest.TestCase):
    def test_included_files(self):
        head, tail = cube(force()).split(GRID)
        for line in (
            "INCLUDE 'parts/grids.bdf'\n",
            "include   parts/grids.bdf $ comment\n",
            'INCLUDE "parts/grids.bdf"\n',
            "INCLUDE 'parts/\n   grids.\nbdf'\n",
            "INCLUDE 'parts\\grids.bdf'\n",
            "INCLUDE='parts/grids.bdf'\n",
        ):
            files = {"parts/grids.bdf": "INCLUDE 'one.bdf'\n", "parts/one.bdf": GRID}
            self.assertEqual(imported(head + line + tail, files).options, WANTED)

    def test_included_control(self):
        text = "INCLUDE 'control.dat'\n" + cube(force()).replace(CONTROL, "")
        self.assertEqual(imported(text, {"control.dat": CONTROL}).options, WANTED)

    def test_files_that_are_missing_or_endless(self):
        (row,) = refusals(cube(force() + "INCLUDE 'none.bdf'\n"))
        self.assertRegex(row, r"^deck.bdf:\d+: INCLUDE: there is no file .*none.bdf")
        (row,) = refusals(cube(force() + "INCLUDE 'a.bdf'\n"), {"a.bdf": "INCLUDE 'a.bdf'\n"})
        self.assertRegex(row, r"^a.bdf:1: INCLUDE: a.bdf includes itself")
        (row,) = refusals(cube(force() + "INCLUDE\n"))
        self.assertIn("no file is named", row)
        rows = refusals(cube(force() + "INCLUDE 'a\n"))
        self.assertIn("the quoted name of the file does not end", rows[0])

    def test_lines_after_the_end_are_named(self):
        one = imported(cube(force()) + "GRID,99\n$ comment\nGRID,100\n")
        self.assertTrue(any("2 lines after ENDDATA" in text for text in one.journal.choices))


class Control(unittest.TestCase):
    def test_a_deck_of_bulk_data_only(self):
        one = imported(cube(force(), control=""))
        self.assertEqual(one.options, WANTED)
        self.assertTrue(any("no case control" in text for text in one.journal.choices))

    def test_sets_are_those_of_the_case_control(self):
        other = "SPC1,11,123,5\nFORCE,21,6,,9.,1.,0.,0.\n"
        one = imported(cube(force() + other))
        self.assertEqual(one.options, WANTED)
        self.assertIn("FORCE | not used | set 21 is not selected", one.account)
        swapped = CONTROL.replace("= 10", "= 11").replace("20", "21")
        one = imported(cube(force() + other, control=swapped))
        self.assertEqual(list(one.options["constraint"]), ["spc_11"])
        self.assertEqual(list(one.options["load"]), ["node_6"])

    def test_sets_that_are_not_there(self):
        rows = refusals(cube(force(), control=CONTROL.replace("= 10", "= 12").replace("20", "22")))
        self.assertIn("there is no set 12 of SPC or SPC1", rows[0])
        self.assertIn("no load has the set 22", rows[1])

    def test_subcases(self):
        control = "SOL 101\nCEND\nTITLE = two, of them,\nSPC = 10\nSUBCASE 1\n LOAD = 20\n"
        control += "SUBCASE 2\n  LOAD = 21\n  DISP(PLOT,\n PRINT) = ALL\nBEGIN BULK\n"
        cards = force() + "FORCE,21,6,,9.,1.,0.,0.\n"
        one = imported(cube(cards, control=control))
        self.assertEqual(one.options, WANTED)
        self.assertTrue(any("that of subcase 1" in text for text in one.journal.choices))
        one = imported(cube(cards, control=control), subcase=2)
        self.assertEqual(one.options["load"], {"node_6": {"force": "9.0,0.0,0.0"}})
        (row,) = refusals(cube(cards, control=control), subcase=3)
        self.assertIn("subcase 3 does not exist", row)

    def test_modes_of_a_preloaded_state(self):
        control = "SOL 103\nCEND\nSPC = 10\nSUBCASE 1\n LOAD = 20\nSUBCASE 2\n METHOD = 5\n"
        text = cube(force() + "EIGRL,5,,,4\n", control=control + " STATSUB = 1\nBEGIN BULK\n")
        one = imported(text)
        self.assertEqual(one.options["modes"]["count"], 4)
        self.assertEqual(one.options["elasticity"]["prestress"], True)
        self.assertEqual(one.options["load"], WANTED["load"])
        one = imported(text.replace(" STATSUB = 1\n", ""))
        self.assertNotIn("load", one.options)

    def test_bands(self):
        control = "SOL 103\nCEND\nSPC = 10\nMETHOD = 5\nBEGIN BULK\n"
        for card, count, band in (
            ("EIGRL,5,0.,3000.,7\n", 7, 3000.0),
            ("EIGR,5,LAN,,3000.,,7\n,MASS\n", 7, 3000.0),
            ("EIGRL,5,,900.\n", 200, 900.0),
        ):
            one = imported(cube(card, control=control))
            self.assertEqual(one.options["modes"]["count"], count)
            self.assertEqual(one.options["flutter"]["band"], band)

    def test_commands_that_are_refused(self):
        for command, reason in (
            ("TEMP(LOAD) = 3", "temperatures and their strains"),
            ("K2GG = STIF", "matrices of DMIG"),
            ("SUPORT1 = 4", "free bodies"),
            ("XYZZY = 4", "this command is not supported"),
            ("LOAD = ALL", "is not the number of a set"),
        ):
            control = CONTROL.replace("BEGIN", f"{command}\nBEGIN")
            (row,) = refusals(cube(force(), control=control))
            self.assertIn(f"deck.bdf:5: {command.split('(')[0].split(' ')[0][:4]}", row)
            self.assertIn(reason, row)
        (row,) = refusals(cube(force(), control=CONTROL.replace("101", "111")))
        self.assertIn("SOL: the solution 111 is not computed", row)
        rows = refusals(cube(force(), control=CONTROL.replace("BEGIN BULK\n", "")))
        self.assertIn("BEGIN BULK is missing", rows[0])


if __name__ == "__main__":
    unittest.main()
