#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The language of decks: lines, cards, numbers, nodes, elements, sets and surfaces."""
import sys
import unittest
from pathlib import Path

import numpy as np

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/deck")]
sys.dont_write_bytecode = True
from small_decks import CUBE, HELD, STATIC, STEEL, Imported, cube, model_of, refused

from squeal.deck.inp.cards import fields_of, key_of
from squeal.deck.journal import Fault
from squeal.deck.numbers import integer, real

FORCE = "*CLOAD\nTOP, 3, 2.\n"


class Lines(unittest.TestCase):
    def test_line_ends_tabs_and_comments(self):
        text = "   ** comment\n" + cube(step=FORCE).replace("*NSET", " ** indented\n\n\t*NSET")
        wanted = Imported(cube(step=FORCE)).options
        for changed in (text, text.replace("\n", "\r\n"), text.replace("\n", "\r")):
            self.assertEqual(Imported(changed).options, wanted)

    def test_encodings_are_named(self):
        marked = Imported(b"\xef\xbb\xbf" + cube().encode())
        self.assertIn("byte order mark", marked.journal.choices[0])
        latin = Imported(("*HEADING\nTräger\n" + cube()).encode("latin-1"))
        self.assertIn("ISO 8859-1", latin.journal.choices[0])

    def test_included_files_take_the_place_of_their_card(self):
        head, tail = cube(step=FORCE).split("5, 0., 0., 1.\n")
        files = {
            "parts/rest.inp": tail,
            "parts/nodes.inp": "5, 0., 0., 1.\n*INCLUDE,INPUT=rest.inp",
        }
        one = Imported(head + '*Include, input="parts/nodes.inp"\n', files)
        self.assertEqual(one.options["load"]["TOP"]["force"], "0.0,0.0,8.0")
        self.assertEqual(list(one.nodes), list(range(1, 9)))

    def test_lines_of_data_in_another_file(self):
        head, rows = cube(step=FORCE).split("*NODE, NSET=ALL\n")
        nodes, rest = rows.split("*ELEMENT", 1)
        one = Imported(
            head + "*NODE, NSET=ALL, INPUT=nodes.inp\n*ELEMENT" + rest, {"nodes.inp": nodes}
        )
        self.assertEqual(list(one.nodes), list(range(1, 9)))
        self.assertEqual(one.remarks("NODE")[0], "used")
        rows = refused(head + "*Node, Input = none.inp\n*ELEMENT" + rest)
        self.assertRegex(rows[0], r"^deck.inp:1: \*NODE: there is no file .*none.inp")

    def test_faults_in_data_of_another_file_name_that_file(self):
        text = cube().replace("5, 0., 0., 1.\n", "*INCLUDE, INPUT=part.inp\n")
        (row, *_) = refused(text, {"part.inp": "** a comment\n5, 0., x, 1.\n"})
        self.assertEqual(row, "part.inp:2: *NODE: 'x' is not a number")

    def test_included_files_that_are_missing_or_endless(self):
        (row,) = refused(cube() + "*INCLUDE, INPUT=sub/none.inp\n")
        self.assertRegex(row, r"^deck.inp:\d+: \*INCLUDE: there is no file .*sub/none.inp")
        (row,) = refused(cube() + "*INCLUDE, INPUT=a.inp\n", {"a.inp": "*INCLUDE, INPUT=a.inp\n"})
        self.assertRegex(row, r"^a.inp:1: \*INCLUDE: a.inp includes itself")
        (row,) = refused(cube() + "*INCLUDE\n")
        self.assertIn("names no file", row)

    def test_data_before_the_first_card(self):
        (row,) = refused("1, 2, 3\n" + cube())
        self.assertIn("deck.inp:1: *(no card): a line of data before the first card", row)


class Cards(unittest.TestCase):
    def test_case_blanks_and_empty_parameters(self):
        text = cube(step=FORCE)
        for old, new in (
            ("*END STEP", "*ENDSTEP"),
            ("*ELEMENT, TYPE=C3D8, ELSET=CUBE", "* element,, elset = cube , type = c3d8,"),
            (
                "*SOLID SECTION, ELSET=CUBE, MATERIAL=STEEL",
                "*solidsection,material=steel,elset=Cube",
            ),
            ("*NSET, NSET=TOP", "*Nset, nset = T o p"),
        ):
            text = text.replace(old, new)
        one = Imported(text)
        self.assertEqual(one.options["load"]["T_o_p"]["force"], "0.0,0.0,8.0")
        self.assertEqual(list(one.options["material"]), ["cube"])

    def test_comma_at_the_end_of_a_keyword_line(self):
        for text, reading in (
            ("*NSET, NSET=MORE,\nTOP, 1\n", "read as data"),
            ("*NSET, NSET=MORE,\nGENERATE\n5, 8\n1, 1\n", "read as a continuation"),
        ):
            one = Imported(cube(text, "*CLOAD\nMORE, 3, 2.\n"))
            self.assertEqual(one.groups["MORE"], [1, 5, 6, 7, 8])
            self.assertTrue(any(reading in choice for choice in one.journal.choices))

    def test_short_words_are_named(self):
        text = "*NSET, NSET=MORE, GEN\n5, 8\n1, 1, 1\n"
        one = Imported(cube(text, "*CLO\nMORE, 3, 2.\n"))
        self.assertEqual(one.groups["MORE"], [1, 5, 6, 7, 8])
        self.assertTrue(any("GEN is read as GENERATE" in one for one in one.journal.choices))
        self.assertTrue(any("*CLO is read as *CLOAD" in one for one in one.journal.choices))

    def test_whole_keywords_are_matched(self):
        rows = refused(cube("*NODE RESPONSE\n1, 2., 3., 4.\n*ELEMENT MATRIX\n7, 1\n*5e8, 0\n"))
        cards = [row.split(": ")[1] for row in rows]
        self.assertEqual(cards, ["*NODE RESPONSE", "*ELEMENT MATRIX", "*5E8"])
        self.assertIn("unknown card", rows[1])

    def test_unknown_parameters_are_refused_and_can_be_ignored(self):
        text = cube(step="*CLOAD, FOLLOWER, WHEN=NOW\nTOP, 3, 2.\n")
        rows = refused(text)
        self.assertEqual([row.split(": ")[1] for row in rows], ["*CLOAD, FOLLOWER", "*CLOAD, WHEN"])
        one = Imported(text, ignored=["follower", "WHEN"])
        self.assertIn("ignored by --ignore FOLLOWER", one.remarks("CLOAD")[1])
        note = one.options["report"]["note"]
        self.assertEqual(note, "left out of deck.inp by --ignore: follower, WHEN")
        self.assertEqual(one.options["load"]["TOP"]["force"], "0.0,0.0,8.0")

    def test_thirty_unsupported_cards_are_named_at_once(self):
        model = """BEAM SECTION|SHELL SECTION|MEMBRANE SECTION|GAP|NMAP|GASKET SECTION|NORMAL
SUBMODEL|CYCLIC SYMMETRY MODEL|GAP CONDUCTANCE|CLEARANCE|DISTRIBUTION|USER ELEMENT|FLUID SECTION
NONSTRUCTURAL MASS|DESIGN VARIABLES|MODAL DAMPING|MODEL CHANGE|CONNECTOR SECTION|SURFACE WEAR"""
        step = """TEMPERATURE|FILM|RADIATE|DFLUX|CFLUX|CHANGE MATERIAL|CONTACT DAMPING|VIEWFACTOR
CONTACT INTERFERENCE|BASE MOTION"""
        before, within = (text.replace("\n", "|").split("|") for text in (model, step))
        text = cube(
            "".join(f"*{name}, ELSET=CUBE\n1., 2.\n" for name in before),
            "".join(f"*{name}\n1, 2.\n" for name in within),
        )
        rows = refused(text)
        self.assertEqual(len(rows), 30)
        lines = text.splitlines()
        for row, name in zip(rows, before + within):
            place, card, _ = row.split(": ", 2)
            self.assertEqual(card, f"*{name}")
            self.assertTrue(lines[int(place.split(":")[1]) - 1].startswith(f"*{name}"))
        one = Imported(text, ignored=before + within)
        self.assertEqual(one.account.count("ignored by --ignore"), 30)

    def test_lines_of_data_are_accounted_for(self):
        for card, reason in (
            ("*MATERIAL, NAME=M\n1., 2.\n", "at most 0 lines of data"),
            ("*TRANSFORM, NSET=TOP\n0, 1, 0, 1, 0, 0\n3., 4.\n", "at most 1 lines of data"),
            ("*MATERIAL, NAME=M\n*ELASTIC\n1., 0.3, 20., 7.\n", "has 2 constants"),
            ("*BOUNDARY\nTOP, 1, 1, 0., 5.\n", "a line has a node or set, two components"),
            ("*RIGID BODY, ELSET=, REF NODE=1\n", "ELSET= has no value"),
        ):
            (row,) = refused(cube(card))
            self.assertIn(reason, row)

    def test_names_with_blanks_and_sections_of_other_sets(self):
        text = cube().replace("NAME=STEEL", "NAME=Cast iron").replace("=STEEL", "=CAST IRON")
        text = text.replace("*SOLID SECTION, ELSET=CUBE", "*SOLID SECTION, ELSET=OTHER")
        one = Imported(text + "*ELSET, ELSET=OTHER\n1\n")
        self.assertEqual(one.options["material"]["OTHER"]["young"], 210000.0)

    def test_quoted_names(self):
        text = cube('*NSET, NSET="Upper face, left"\nTOP\n', '*CLOAD\n"upper face, left", 1, 1.\n')
        one = Imported(text)
        self.assertEqual(one.groups["Upper_face__left"], [5, 6, 7, 8])
        self.assertEqual(fields_of('"a, b", 2,'), ['"a, b"', "2"])
        self.assertEqual(fields_of("a,,b"), ["a", "", "b"])
        self.assertEqual(key_of("B ot"), "BOT")

    def test_numbers(self):
        for text, value in (
            *(("1.+2", 100.0), ("1.D2", 100.0), ("1d-2", 0.01), (".5", 0.5), ("-3", -3.0)),
            ("123456789.123456789123", 123456789.123456789123),
        ):
            self.assertEqual(real(text), value)
        self.assertEqual(integer("5."), 5)
        for text in ("", "1.2.3", "e5", "nan", "1 2", "0x1"):
            self.assertRaises(Fault, real, text)
        self.assertRaises(Fault, integer, "5.5")


class Mesh(unittest.TestCase):
    def test_nodes_in_several_blocks_with_few_fields(self):
        text = CUBE.replace("1, 0., 0., 0.\n", "1,\n").replace("4, 0., 1., 0.", "4, , 1.\n*NODE")
        one = Imported(text + STEEL + HELD + STATIC.format(FORCE))
        self.assertEqual(one.coordinates.tolist(), Imported(cube()).coordinates.tolist())

    def test_the_last_of_equal_node_numbers_counts_and_is_named(self):
        one = Imported(cube() + "*NODE\n8, 0., 1., 1.25\n")
        self.assertEqual(one.coordinates[7].tolist(), [0, 1, 1.25])
        self.assertTrue(any("defined twice, such as 8" in text for text in one.journal.choices))

    def test_records_of_elements_on_several_lines(self):
        wanted = Imported(cube()).groups["CUBE"]
        for record in ("1, 1, 2, 3,\n4, 5, 6, 7, 8,", "1, 1, 2\n3, 4, 5, 6,\n\n7, 8"):
            text = cube().replace("1, 1, 2, 3, 4, 5, 6, 7, 8", record)
            self.assertEqual(Imported(text).groups["CUBE"], wanted)

    def test_records_with_missing_nodes_are_refused(self):
        rows = refused(cube().replace("1, 1, 2, 3, 4, 5, 6, 7, 8", "1, 1, 2, 3, 4, 5, 6, 7"))
        self.assertIn("deck.inp:11: *ELEMENT: an element of this type has 8 nodes", rows[0])

    def test_the_type_is_that_of_the_parameter(self):
        one = Imported(cube().replace("CUBE", "S4_B31"))
        self.assertEqual(len(one.groups["S4_B31"]), 1)

    def test_unsupported_types_are_named_once_each(self):
        shells = "*ELEMENT, TYPE=S4, ELSET=SKIN\n7, 1, 2, 3, 4\n*SHELL SECTION, ELSET=SKIN\n0.1\n"
        rows = refused(cube(shells + "*ELEMENT, TYPE=B31\n8, 1, 2\n"))
        cards = [row.split(": ")[1] for row in rows]
        self.assertEqual(cards, ["*ELEMENT, S4", "*SHELL SECTION", "*ELEMENT, B31"])

    def test_unknown_nodes_and_elements_defined_twice(self):
        self.assertIn(
            "there is no node 9", refused(cube().replace("7, 8\n*NSET", "7, 9\n*NSET"))[0]
        )
        again = "*ELEMENT, TYPE=C3D8, ELSET=CUBE\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
        self.assertIn("element 1 is defined twice", refused(cube(again))[0])
        wedge = cube().replace("1, 1, 2, 3, 4, 5, 6, 7, 8", "1, 1, 2, 3, 3, 5, 6, 7, 7")
        self.assertIn("element 1 has a node twice", refused(wedge)[0])

    def test_decks_that_are_cut_off(self):
        (row,) = refused(cube().replace("*END STEP\n", ""))
        self.assertIn("*STEP: *END STEP is missing", row)
        (row,) = refused(cube(after="*FREQUENCY\n3\n"))
        self.assertIn("*FREQUENCY: this card belongs after *STEP", row)

    def test_rows_of_nodes(self):
        model, _ = model_of("*NODE\n1, 0., 0., 0.\n9, 4., 0., 8.\n*NGEN, NSET=ROW\n1, 9, 2\n")
        self.assertEqual(model.node_sets.members("ROW").tolist(), [1, 3, 5, 7, 9])
        self.assertTrue(np.array_equal(model.nodes.at([5]), [[2, 0, 4]]))


class Sets(unittest.TestCase):
    def members(self, text, key, kind="node_sets"):
        model, journal = model_of(text)
        self.assertEqual(journal.refusals, [])
        return getattr(model, kind).members(key).tolist(), journal.choices

    def test_ways_to_define_a_set(self):
        for text in (
            "*NODE, NSET=S\n3, 0.\n4, 0.\n5, 0.\n",
            "*NSET, NSET=S, GENERATE\n3, 5\n",
            "*NSET, generate, nset=s\n3, 5, 1\n",
            "*NSET, NSET=S\n3,\n4,\n5,\n",
            "*NSET, NSET=S\n3, 4\n*NSET, NSET=s\n5\n",
            "*NSET, NSET=A\n3\n*NSET, NSET=B\n4, 3\n*NSET, NSET=S\nA, B, 5\n",
        ):
            self.assertEqual(self.members(text, "S")[0], [3, 4, 5])

    def test_sets_of_sets_defined_later_are_named(self):
        members, choices = self.members("*NSET, NSET=S\nA, 2\n*NSET, NSET=A\n1\n", "S")
        self.assertEqual(members, [1, 2])
        self.assertIn("set 'A' is defined later", choices[0])

    def test_a_set_whose_name_is_a_number(self):
        members, choices = self.members("*NSET, NSET=5\n1\n*NSET, NSET=S\n5\n", "S")
        self.assertEqual(members, [5])
        self.assertIn("5 is read as a number, not as a set", choices[0])

    def test_node_and_element_sets_of_one_name(self):
        text = cube("*NSET, NSET=CUBE\nTOP\n", "*CLOAD\nCUBE, 1, 1.\n")
        one = Imported(text)
        self.assertEqual(one.groups["CUBE_nodes"], [5, 6, 7, 8])
        self.assertEqual(one.options["load"]["CUBE_nodes"]["force"], "4.0,0.0,0.0")
        self.assertEqual(list(one.options["material"]), ["CUBE"])

    def test_sets_are_sorted_unless_they_are_unsorted(self):
        """Abaqus pairs the nodes of two sets in *EQUATION and *MPC by their places in the sets."""
        for word, wanted in (("", [5, 6, 7, 8]), (", UNSORTED", [8, 6, 7, 5])):
            members, _ = self.members(f"*NSET, NSET=S{word}\n8, 6, 7, 5, 6\n", "S")
            self.assertEqual(members, wanted)
            members, _ = self.members(f"*NSET, NSET=A{word}\n8, 6\n*NSET, NSET=A\n7, 5\n", "A")
            self.assertEqual(members, wanted)
        members, _ = self.members("*NSET, NSET=A, UNSORTED\n8, 6\n*NSET, NSET=S\nA, 7\n", "S")
        self.assertEqual(members, [6, 7, 8])

    def test_properties_given_twice(self):
        """None of two is right: neither the last one nor their sum."""
        point = "*NODE\n9, 0., 0., 3.\n*ELEMENT, TYPE=MASS, ELSET=M\n9, 9\n"
        mass, contact = "*MASS, ELSET=M\n1.\n", "*SURFACE INTERACTION, NAME=I\n"
        for model, step, reason in (
            ("*MATERIAL, NAME=S\n*DENSITY\n1.\n*DENSITY\n2.\n", "", "has two densities"),
            (point + mass + mass, "", "element 9 has a second mass"),
            (contact + "*FRICTION\n0.2\n*FRICTION\n0.4\n", "", "two laws of friction"),
            (contact + 2 * "*SURFACE BEHAVIOR\n", "", "two laws of contact"),
            (contact + "*FRICTION\n0.2\n", "*FRICTION\n0.4\n", "in a step, after *CHANGE"),
        ):
            rows = refused(cube(model, step), dialect="abaqus")
            self.assertTrue(any(reason in row for row in rows), (model, rows))
        rows = refused(cube(after="*STEP\n*FREQUENCY\n-2\n*END STEP\n"), dialect="abaqus")
        self.assertTrue(any("frequencies is not positive" in row for row in rows), rows)

    def test_names_that_python_reads_as_numbers(self):
        members, _ = self.members("*NSET, NSET=1_2\n7\n*NSET, NSET=S\n1_2, 5\n", "S")
        self.assertEqual(members, [5, 7])
        self.assertIn("'1_0' is not", refused(cube().replace("\n7, 1.", "\n1_0, 1."))[0])
        self.assertIn("'0_5' is not", refused(cube().replace("\n7, 1.", "\n7, 0_5"))[0])

    def test_sets_of_sets_to_any_depth(self):
        chain = "".join(f"*NSET, NSET=S{one}\nS{one + 1}, TOP\n" for one in range(2000))
        one = Imported(cube(chain + "*NSET, NSET=S2000\n6\n", "*CLOAD\nS0, 1, 2.\n"))
        self.assertEqual(sorted(one.groups["S0"]), [5, 6, 7, 8])

    def test_sets_that_are_wrong(self):
        for text, reason in (
            ("*NSET, NSET=S, GENERATE\n5, 3\n", "the range 5, 3, 1 is empty"),
            ("*NSET, NSET=S, GENERATE\n5\n", "a line of GENERATE has first, last and step"),
            ("*NSET\n5\n", "NSET= is missing"),
            ("*NSET, NSET=\n5\n", "NSET= has no value"),
        ):
            (row,) = refused(cube(text))
            self.assertIn(reason, row)
        (row,) = refused(cube("*NSET, NSET=S\nS, 1\n", "*CLOAD\nS, 1, 1.\n"))
        self.assertIn("the node set 'S' contains itself", row)
        loop = "*NSET, NSET=A\nB\n*NSET, NSET=B\n5, C\n*NSET, NSET=C\nB\n"
        (row,) = refused(cube(loop, "*CLOAD\nA, 1, 1.\n"))
        self.assertIn("the node set 'B' contains itself", row)
        (row,) = refused(cube("", "*CLOAD\nNONE, 1, 1.\n"))
        self.assertIn("there is no node set 'NONE'", row)

    def test_surfaces_are_found_after_their_use(self):
        surfaces = "*SURFACE, NAME=UP\nLATE, S2\n*ELSET, ELSET=LATE\n1\n"
        one = Imported(cube("", "*DSLOAD\nUP, P, 3.\n", surfaces))
        self.assertEqual(one.options["load"]["UP"]["pressure"], 3.0)
        self.assertEqual(sorted(one.groups["UP"][0]), [5, 6, 7, 8])


if __name__ == "__main__":
    unittest.main()
