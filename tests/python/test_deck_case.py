#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Cases of decks: what materials, supports and loads become, and the account of all cards."""
import re
import sys
import tempfile
import time
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/deck")]
sys.dont_write_bytecode = True
from small_decks import CUBE, HELD, STATIC, STEEL, Imported, cube, numbers, refused

from squeal.deck.case.groups import NODES, Case
from squeal.deck.importer import import_deck
from squeal.deck.journal import DeckError
from squeal.deck.output.msh import partition

ORTHO = "500000.,157200.,400000.,157200.,157200.,300000.,126200.,126200.,\n126200.,294."


class Materials(unittest.TestCase):
    def materials(self, cards, section=""):
        text = (
            CUBE + f"*MATERIAL, NAME=M\n{cards}\n*SOLID SECTION, ELSET=CUBE, MATERIAL=M{section}\n"
        )
        return Imported(text + HELD + STATIC.format(""))

    def test_laws(self):
        for kind, data, key, count in (
            ("ORTHO", ORTHO, "orthotropic", 9),
            ("ENGINEERING CONSTANTS", "3.,2.,1.,.1,.2,.3,4.,5.,\n6.,", "engineering_constants", 9),
            ("ANISO", "1,2,3,4,5,6,7,8\n9,10,11,12,13,14,15,16\n17,18,19,20,21", "anisotropic", 21),
        ):
            one = self.materials(f"*DENSITY\n1.\n*ELASTIC, TYPE={kind}\n{data}")
            found = numbers(one.options["material"]["CUBE"][key])
            given = [float(word) for word in re.split(r"[,\s]+", data.strip(",")) if word]
            self.assertEqual(found, given[:count])

    def test_orientations(self):
        section = ", ORIENTATION=AXES\n*ORIENTATION, NAME=AXES{}"
        law = f"*DENSITY\n1.\n*ELASTIC, TYPE=ORTHO\n{ORTHO}"
        one = self.materials(law, section.format("\n0., 0., 1., 1., 0., 0."))
        self.assertEqual(
            numbers(one.options["material"]["CUBE"]["orientation"]), [0, 0, 1, 1, 0, 0]
        )
        axes = section.format(", SYSTEM=CYLINDRICAL\n1., 2., 3., 1., 2., 5.")
        one = self.materials(law, axes)
        self.assertEqual(
            numbers(one.options["material"]["CUBE"]["cylindrical"]), [1, 2, 3, 0, 0, 2]
        )
        one = self.materials("*ELASTIC\n1., 0.\n*DENSITY\n1.", axes)
        self.assertEqual(one.remarks("ORIENTATION")[0], "not used")

    def test_a_missing_density_is_named(self):
        one = self.materials("*ELASTIC\n1., 0.")
        self.assertEqual(one.options["material"]["CUBE"]["density"], 1.0)
        self.assertTrue(any("no *DENSITY: the density 1" in text for text in one.journal.choices))
        rows = refused(
            cube(step="*DLOAD\nCUBE, GRAV, 9.81, 0., 0., -1.\n").replace("*DENSITY\n7.8E-9\n", "")
        )
        self.assertIn("*DLOAD: material 'STEEL' has no *DENSITY", rows[0])

    def test_laws_that_matter_only_if_they_are_used(self):
        rubber = "*MATERIAL, NAME=RUBBER\n*HYPERELASTIC, OGDEN\n1., 2., 0.\n"
        one = Imported(cube(rubber))
        self.assertEqual(one.remarks("HYPERELASTIC")[0], "not used")
        text = cube(rubber).replace("ELSET=CUBE, MATERIAL=STEEL", "ELSET=CUBE, MATERIAL=RUBBER")
        (row,) = refused(text)
        self.assertIn("*HYPERELASTIC: hyperelasticity is not supported", row)

    def test_sections(self):
        (row,) = refused(cube("*SOLID SECTION, ELSET=CUBE, MATERIAL=STEEL\n"))
        self.assertIn("element 1 has two sections", row)
        (row,) = refused(cube().replace("*SOLID SECTION, ELSET=CUBE, MATERIAL=STEEL\n", ""))
        self.assertIn("1 solid elements have no *SOLID SECTION", row)
        (row,) = refused(cube().replace("MATERIAL=STEEL", "MATERIAL=IRON"))
        self.assertIn("there is no material 'IRON'", row)

    def test_bodies_have_one_material_and_equal_loads(self):
        second = "*NODE\n11, 0., 0., 2.\n12, 1., 0., 2.\n13, 1., 1., 2.\n14, 0., 1., 2.\n"
        second += "*ELEMENT, TYPE=C3D8, ELSET=CUBE\n2, 5, 6, 7, 8, 11, 12, 13, 14\n"
        loads = "*DLOAD\nCUBE, GRAV, 2., 0., 0., -3.\n2, CENTRIF, 9., 1., 0., 0., 0., 2., 0.\n"
        one = Imported(cube(second, loads))
        self.assertEqual(sorted(one.options["material"]), ["CUBE", "CUBE_body"])
        spun = next(name for name in one.groups if "CUBE" in name and 11 in one.groups[name][0])
        load = one.options["load"][spun]
        self.assertEqual(numbers(load["acceleration"]), [0, 0, -2])
        self.assertEqual((load["spin"], load["spin_axis"]), (3.0, "0.0,1.0,0.0"))
        self.assertEqual(numbers(load["spin_origin"]), [1, 0, 0])


class State(unittest.TestCase):
    def test_ways_to_hold(self):
        for card, name, held in (
            ("1, 1\n", "node_1", "x"),
            ("TOP, 2,, 0\n", "TOP", "y"),
            ("TOP, 1, 3\n", "TOP", "xyz"),
            ("TOP, ZSYMM\n", "TOP", "z"),
            ("TOP, PINNED\n", "TOP", "xyz"),
            ("TOP, 3\n*BOUNDARY\nTOP, 1\n", "TOP", "xz"),
        ):
            one = Imported(CUBE + STEEL + "*BOUNDARY\n" + card + STATIC.format(""))
            self.assertEqual(one.options["constraint"], {name: {"clamped": held}})

    def test_prescribed_values_and_their_replacement(self):
        step = "*BOUNDARY\nTOP, 3, 3, 0.5\n7, 3, 3, 0.25\n"
        one = Imported(cube(step=step))
        self.assertEqual(one.options["constraint"]["node_7"]["displacement"], "0.0,0.0,0.25")
        self.assertEqual(one.groups["TOP"], [5, 6, 8])
        last = "*STEP\n*STATIC\n*BOUNDARY, OP=NEW\nTOP, 1, 2\n*END STEP\n"
        one = Imported(cube(step=step, after=last))
        self.assertEqual(one.options["constraint"], {"TOP": {"clamped": "xy"}})

    def test_new_on_a_later_card_of_a_step(self):
        """Abaqus does not accept it, and CalculiX ignores it."""
        (row,) = refused(cube(step="*BOUNDARY\n7, 3, 3\n*BOUNDARY, OP=NEW\nTOP, 1, 2\n"))
        self.assertIn("OP=NEW must stand on the first *BOUNDARY of the step", row)
        both = "*BOUNDARY, OP=NEW\nTOP, 1, 2\n*BOUNDARY, OP=NEW\n7, 3, 3\n"
        self.assertEqual(
            Imported(cube(step=both)).options["constraint"]["node_7"], {"clamped": "xyz"}
        )

    def test_components_without_a_meaning(self):
        (row,) = refused(cube(step="*BOUNDARY\nTOP, 11, 11, 20.\n"))
        self.assertIn("temperatures (11) are not supported", row)
        (row,) = refused(cube(step="*CLOAD\nTOP, 4, 20.\n"))
        self.assertIn("node 5 of solid cells has no rotations", row)

    def test_forces_of_steps(self):
        """CalculiX adds forces of one step and replaces those of earlier ones."""
        first = "*CLOAD\nTOP, 3, 1.\n*CLOAD\nTOP, 3, 2.\n"
        self.assertEqual(Imported(cube(step=first)).options["load"]["TOP"]["force"], "0.0,0.0,12.0")
        second = "*STEP\n*STATIC\n*CLOAD{}\n5, 3, 5.\n*END STEP\n"
        load = Imported(cube(step=first, after=second.format(""))).options["load"]
        self.assertEqual(
            load, {"node_5": {"force": "0.0,0.0,5.0"}, "TOP": {"force": "0.0,0.0,9.0"}}
        )
        load = Imported(cube(step=first, after=second.format(", OP=NEW"))).options["load"]
        self.assertEqual(load, {"node_5": {"force": "0.0,0.0,5.0"}})

    def test_distributed_loads_of_steps(self):
        """CalculiX adds pressures of one step, and gravities also of different directions."""
        first = "*DLOAD\nCUBE, P2, 1.\n1, P2, 2.\nCUBE, GRAV, 1., 0., 0., -1.\n"
        first += "1, GRAV, 3., -1., 0., 0.\n"
        second = "*STEP\n*STATIC\n*DLOAD\nCUBE, P2, 7.\nCUBE, GRAV, 5., 0., 0., -2.\n*END STEP\n"
        for after, pressure, gravity in (("", 3.0, [-3, 0, -1]), (second, 7.0, [-3, 0, -5])):
            one = Imported(cube(step=first, after=after))
            body = one.options["load"]["CUBE"]
            self.assertEqual(numbers(body["acceleration"]), gravity)
            (face,) = (name for name, keys in one.options["load"].items() if "pressure" in keys)
            self.assertEqual(one.options["load"][face]["pressure"], pressure)
            self.assertEqual(sorted(one.groups[face][0]), [5, 6, 7, 8])

    def test_pressure_between_two_elements(self):
        second = "*NODE\n11, 0., 0., 2.\n12, 1., 0., 2.\n13, 1., 1., 2.\n14, 0., 1., 2.\n"
        second += "*ELEMENT, TYPE=C3D8, ELSET=CUBE\n2, 5, 6, 7, 8, 11, 12, 13, 14\n"
        for load, number in (("1, P2", "2 of element 1"), ("2, P1", "1 of element 2")):
            (row,) = refused(cube(second, f"*DLOAD\n2, P2, 5.\n{load}, 5.\n"))
            self.assertIn(f"face {number} lies between two elements", row)
        self.assertEqual(len(Imported(cube(second, "*DLOAD\n2, P2, 5.\n")).groups["pressed"]), 1)
        (row,) = refused(cube(second, "*DLOAD\n2, P7, 5.\n"))
        self.assertIn("'P7' is not a face", row)

    def test_transformed_axes(self):
        axes = "*TRANSFORM, NSET=TOP, TYPE=C\n0., 0., 0., 0., 0., 1.\n"
        one = Imported(cube(axes, "*CLOAD\n7, 2, 3.\n*BOUNDARY\n6, 1\n"))
        frame = one.options["frame"]["transform_1"]
        self.assertEqual((frame["origin"], frame["axis"]), ("0.0,0.0,0.0", "0.0,0.0,1.0"))
        self.assertEqual(
            one.options["load"]["node_7"], {"force": "0.0,3.0,0.0", "frame": "transform_1"}
        )
        self.assertEqual(one.options["constraint"]["node_6"]["frame"], "transform_1")

    def test_steps(self):
        frequency = "*STEP{}\n*FREQUENCY, STORAGE=YES\n12, 1.\n*CLOAD\nTOP, 1, 1.\n*END STEP\n"
        one = Imported(cube(after=frequency.format("")))
        self.assertEqual(one.options["modes"]["count"], 12)
        self.assertNotIn("load", one.options)
        text = cube(after=frequency.format(", PERTURBATION"))
        one = Imported(text, dialect="calculix")
        self.assertIs(one.options["elasticity"]["prestress"], True)
        self.assertNotIn("prestress", Imported(text, dialect="abaqus").text)
        text = cube(after=frequency.format("") + frequency.format(", PERTURBATION"))
        rows = refused(text, dialect="calculix")
        self.assertIn("with and without PERTURBATION", rows[0])
        changed = frequency.format("").replace("*CLOAD\nTOP, 1, 1.", "*BOUNDARY\nTOP, 1")
        self.assertIn("supports that change", refused(cube(after=changed))[0])
        other = "*STEP, NLGEOM\n*DYNAMIC\n0.1, 1.\n*CLOAD\nTOP, 1, 1.\n*END STEP\n"
        rows = refused(cube(after=other))
        self.assertEqual([row.split(": ")[1] for row in rows], ["*STEP, NLGEOM", "*DYNAMIC"])
        one = Imported(cube(after=other), ignored=["DYNAMIC"])
        self.assertNotIn("load", one.options)
        self.assertIn("in the step of *DYNAMIC, which is ignored", one.account)


class Account(unittest.TestCase):
    def test_every_card_is_accounted_for(self):
        text = "*HEADING\nA cube\n" + cube(step="*NODE PRINT, NSET=TOP\nU\n*CLOAD\nTOP, 3, 1.\n")
        one = Imported(text)
        cards = [line for line in text.splitlines() if line.startswith("*")]
        self.assertEqual(len(one.journal.entries), len(cards))
        for number, line in enumerate(text.splitlines(), 1):
            if line.startswith("*"):
                card = line.split(",")[0]
                self.assertRegex(one.account, rf"\| deck.inp:{number} \| \{card} \| \w+")
        self.assertEqual(one.remarks("NODE PRINT")[0], "not used")
        self.assertEqual(one.remarks("CLOAD")[0], "translated")
        self.assertIn("| node set | TOP | 4 |", one.account)

    def test_cards_that_nothing_refers_to(self):
        more = "*MATERIAL, NAME=SPARE\n*ELASTIC\n1., 0.\n"
        more += "*ORIENTATION, NAME=SPARE\n1., 0., 0., 0., 1., 0.\n"
        more += "*TRANSFORM, NSET=TOP\n0., 1., 0., 1., 0., 0.\n"
        text = cube(more)
        one = Imported(text)
        lines = text.splitlines()
        idle = {
            lines[source.line - 1]: "; ".join(entry.remarks)
            for source, entry in one.journal.entries.items()
            if entry.status == "not used"
        }
        self.assertEqual(
            idle,
            {
                "*MATERIAL, NAME=SPARE": "no section uses this material",
                "*ELASTIC": "no section uses this material",
                "*ORIENTATION, NAME=SPARE": "nothing uses this orientation",
                "*TRANSFORM, NSET=TOP": "no support, force or equation has these axes",
            },
        )

    def test_cards_without_effect(self):
        more = "*CONTROLS, PARAMETERS=FIELD\n0.005,\n*DAMPING, ALPHA=1., BETA=0.\n"
        text = cube(more + "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, 20.\n")
        one = Imported(text, dialect="calculix")
        for card in ("CONTROLS", "DAMPING", "INITIAL CONDITIONS"):
            self.assertEqual(one.remarks(card)[0], "not used")
        (row,) = refused(cube("*INITIAL CONDITIONS, TYPE=STRESS\n1, 1, 0., 0., 0., 0., 0., 0.\n"))
        self.assertIn("TYPE=STRESS is not supported", row)

    def test_names_of_ignore_that_meet_nothing(self):
        with self.assertRaisesRegex(DeckError, "--ignore PLASTIC: .* has nothing of this name"):
            Imported(cube(), ignored=["PLASTIC"])

    def test_only_folders_of_imports_are_written_to(self):
        with tempfile.TemporaryDirectory() as folder:
            deck, case = Path(folder) / "deck.inp", Path(folder) / "case"
            deck.write_text(cube())
            import_deck(deck, case)
            deck.write_text(cube("*SHELL SECTION, ELSET=CUBE\n1.\n"))
            self.assertRaises(DeckError, import_deck, deck, case)
            self.assertEqual([path.name for path in case.iterdir()], ["import.md"])
            self.assertIn("- deck.inp:", (case / "import.md").read_text())
            (case / "case.yaml").write_text("mesh: {file: brake.msh}\n")
            self.assertRaisesRegex(DeckError, "was not made by", import_deck, deck, case)


class Groups(unittest.TestCase):
    def test_a_group_for_each_node(self):
        """Fields of forces make as many groups as nodes; time and memory grow like their number."""
        case, count = Case(), 20000
        started = time.process_time()
        for number in range(1, count + 1):
            case.group(NODES, [number], "loaded")
        case.group(NODES, range(2, count + 1), "all")
        parts = list(partition(case.groups[NODES]))
        # A quadratic effort is more than a minute.
        self.assertLess(time.process_time() - started, 15)
        self.assertEqual(parts[0][0], ["loaded"])
        self.assertEqual(parts[1][0], ["loaded_nodes", "all"])
        self.assertEqual(parts[-1][0], [f"loaded_{count - 1}", "all"])
        self.assertEqual([part.tolist() for _, part in parts], [[at + 1] for at in range(count)])


class Manual(unittest.TestCase):
    def test_the_example_of_the_page(self):
        """docs/decks.md shows the case of its deck, and the error of one that is changed."""
        page = (repository / "docs/decks.md").read_text()
        blocks = re.findall(r"^```\w*\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
        deck, case, choices, error = blocks[:4]
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "bracket.inp"
            path.write_text(deck)
            journal = import_deck(path, Path(folder) / "bracket")
            self.assertEqual((Path(folder) / "bracket/case.yaml").read_text(), case)
            self.assertEqual("\n".join(journal.choices) + "\n", choices)
            deck = re.sub(r"\*RIGID BODY.*", "*MPC\nBEAM, 21, 22", deck)
            path.write_text(deck.replace("*CLOAD", "*CLOAD, FOLLOWER"))
            with self.assertRaises(DeckError) as raised:
                import_deck(path, Path(folder) / "bracket")
        # The page has the command's name and no path.
        shown = str(raised.exception).replace(f"{folder}/", "squeal-import: ", 1)
        self.assertEqual(shown + "\n", error)

    def test_the_assembly_of_the_page(self):
        page = (repository / "docs/decks.md").read_text()
        blocks = re.findall(r"^```\w*\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "frame.inp"
            path.write_text(blocks[4])
            import_deck(path, Path(folder) / "frame")
            self.assertIn(blocks[5], (Path(folder) / "frame/case.yaml").read_text())


if __name__ == "__main__":
    unittest.main()
