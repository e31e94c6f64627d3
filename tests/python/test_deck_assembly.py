#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Parts and instances: names, numbers, places, and the same case as that of a flat deck."""
import sys
import unittest
from pathlib import Path

import numpy as np

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/deck")]
sys.dont_write_bytecode = True
import assembled
import brake_of_cae
from small_decks import CUBE, STATIC, STEEL, Imported, model_of, refused

# Names of groups and of other things in both decks.
SAME = {
    **{"Block-1": "block", "Arm-1": "arm", "Arm-2": "arm2", "reference_1": "reference_9000"},
    **{"Root1": "ROOT1", "Root2": "ROOT2", "Block-1.Right": "RIGHT", "Upper": "UPPER"},
    **{"Tip": "TIP1", "Arm-2.tip": "TIP2", "Block-1.Foot": "FOOT"},
    **{"First": "FIRST", "Second": "SECOND", "End": "reference_9000"},
}
PART = "*PART, NAME=P\n" + CUBE + STEEL.split("*SOLID")[0].join(["", ""])
SECTION = "*SOLID SECTION, ELSET=CUBE, MATERIAL=STEEL\n"
MATERIAL = STEEL.split("*SOLID")[0]


def assembly(instances, part="", inside="", after=""):
    """Returns the deck of a cube as a part, with more cards in the part, in the assembly and after
    it."""
    return (
        f"*PART, NAME=P\n{CUBE}{SECTION}{part}*END PART\n*ASSEMBLY, NAME=A\n{instances}{inside}"
        f"*END ASSEMBLY\n{MATERIAL}{after}" + STATIC.format("")
    )


def instance(name, lines="", part="P"):
    return f"*INSTANCE, NAME={name}, PART={part}\n{lines}*END INSTANCE\n"


class SameCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        text, files = assembled.assembly()
        cls.one, cls.other = Imported(text, files), Imported(assembled.flat())

    def test_dialects_are_detected(self):
        reason = "dialect: Abaqus, for *PART (deck.inp:3), *SOLID SECTION, controls=EC-1"
        self.assertTrue(self.one.journal.choices[0].startswith(reason))
        reason = "dialect: CalculiX, for *RIGID BODY, NSET=TIP1"
        self.assertTrue(self.other.journal.choices[0].startswith(reason))

    def test_groups_have_the_same_places(self):
        self.assertEqual({SAME[name] for name in self.one.groups}, set(self.other.groups))
        for name, members in self.one.groups.items():
            self.same_places(members, self.other.groups[SAME[name]], name)
        self.same_places(self.one.nodes, self.other.nodes, "all nodes")

    def same_places(self, members, others, name):
        tables = []
        for one, numbers in ((self.one, members), (self.other, others)):
            at = np.searchsorted(one.nodes, np.array(numbers))
            places = one.coordinates[at].reshape(len(numbers), -1)
            tables.append(places[np.lexsort(np.round(places, 9).T)])
        self.assertEqual(tables[0].shape, tables[1].shape, name)
        self.assertLess(np.max(np.abs(tables[0] - tables[1])), 1e-14, name)

    def test_options_are_the_same(self):
        named = {
            prefix: {SAME.get(name, name): self.renamed(value) for name, value in options.items()}
            for prefix, options in self.one.options.items()
        }
        self.assertEqual(named, self.other.options)

    def renamed(self, value):
        if isinstance(value, dict):
            return {key: SAME.get(text, text) for key, text in value.items()}
        return value

    def test_the_account_names_the_numbers_of_instances(self):
        self.assertIn("| Arm-2 | 51 | 21 |", self.one.account)
        self.assertIn("| node set | Tips | 8 |  |", self.one.account)


class Places(unittest.TestCase):
    def test_a_translation_comes_before_the_rotation(self):
        """Turned by the angle 2π/3 about the diagonal, x goes to y, y to z and z to x."""
        turn = "10., 0., 0.\n1., 1., 1., 2., 2., 2., 120.\n"
        model, journal = model_of(assembly(instance("I", turn)))
        self.assertEqual(journal.refusals, [])
        # (1, 0, 0) moves to (11, 0, 0), and from there to (0, 11, 0).
        self.assertLess(np.max(np.abs(model.nodes.at([2])[0] - [0, 11, 0])), 1e-14)

    def test_distances_within_and_between_instances(self):
        """A rotation about an axis keeps distances in the part and from the axis."""
        turn = "3., 4., 5.\n1., 0., 2., 3., 1., 7., -77.\n"
        model, _ = model_of(assembly(instance("I") + instance("J", turn)))
        first, second = (model.nodes.coordinates[at : at + 8] for at in (0, 8))

        def distances(places):
            return np.linalg.norm(places[:, None] - places, axis=2)

        self.assertLess(np.max(np.abs(distances(first) - distances(second))), 1e-14)
        a, axis = np.array([1.0, 0, 2]), np.array([2.0, 1, 5]) / np.sqrt(30)
        for before, after in zip(first + [3, 4, 5], second):
            self.assertAlmostEqual((before - a) @ axis, (after - a) @ axis, delta=1e-14)
            radii = [np.linalg.norm(np.cross(one - a, axis)) for one in (before, after)]
            self.assertAlmostEqual(*radii, delta=1e-14)

    def test_local_systems_of_nodes(self):
        """x along (0, 1, 0), y along (0, 0, 1), so z along (1, 0, 0)."""
        text = "*SYSTEM\n1., 2., 3., 1., 5., 3.\n1., 2., 9.\n*NODE\n1, 10., 20., 30.\n"
        text += "*SYSTEM\n*NODE\n2, 1., 2., 3.\n*NODE, SYSTEM=C\n3, 2., 90., 5.\n"
        text += "*NODE, SYSTEM=S\n4, 2., 90., 45.\n*SYSTEM\n0., 0., 0., 3., 3., 0.\n"
        text += "*NODE\n5, 1., 1., 7.\n"
        model, journal = model_of(text)
        self.assertEqual(journal.refusals, [])
        root = np.sqrt(2)
        wanted = [[31, 12, 23], [1, 2, 3], [0, 2, 5], [0, root, root], [0, root, 7]]
        self.assertLess(np.max(np.abs(model.nodes.coordinates - wanted)), 1e-14)

    def test_axes_turn_with_their_part(self):
        cards = "*ORIENTATION, NAME=O\n1., 0., 0., 0., 1., 0.\n"
        cards += "*ORIENTATION, NAME=C, SYSTEM=CYLINDRICAL\n0., 0., 0., 0., 0., 2.\n"
        turn = "10., 0., 0.\n0., 0., 0., 1., 0., 0., 90.\n"
        model, _ = model_of(assembly(instance("I", turn), cards))
        one, other = model.orientations["I.O"], model.orientations["I.C"]
        self.assertEqual((one.a.tolist(), one.b.tolist()), ([1, 0, 0], [0, 0, 1]))
        self.assertEqual((other.a.tolist(), other.b.tolist()), ([10, 0, 0], [10, -2, 0]))

    def test_directions_in_turned_parts_are_refused(self):
        turn = "0., 0., 0.\n0., 0., 0., 1., 0., 0., 90.\n"
        for card in (
            "*EQUATION\n2\n5, 1, 1., 6, 1, -1.\n",
            "*ELEMENT, TYPE=SPRING1, ELSET=S\n9, 5\n*SPRING, ELSET=S\n1\n3.\n",
            "*SURFACE, NAME=U\nCUBE, S2\n*COUPLING, CONSTRAINT NAME=C, REF NODE=1, SURFACE=U\n"
            "*KINEMATIC\n1, 2\n",
        ):
            rows = refused(assembly(instance("I", turn), card))
            self.assertTrue(any("turned" in row for row in rows), rows)


class NamesOfInstances(unittest.TestCase):
    TWO = instance("I") + instance("J", "5., 0., 0.\n")

    def members(self, inside, key, kind="node_sets"):
        model, journal = model_of(assembly(self.TWO, inside=inside))
        self.assertEqual(journal.refusals, [])
        return getattr(model, kind).members(key).tolist()

    def test_sets_of_instances(self):
        for text in (
            "*NSET, NSET=S, INSTANCE=J\nTOP\n",
            "*NSET, NSET=S, INSTANCE=J\n5, 6, 7, 8\n",
            "*NSET, NSET=S, INSTANCE=J, GENERATE\n5, 8\n",
            "*NSET, NSET=S\nJ.TOP\n",
            "*NSET, NSET=S\nA.J.top\n",
            '*NSET, NSET=S\n"J".Top\n',
            "*NSET, NSET=S\nJ.5, J.6\nJ.7, J.8\n",
            "*NSET, NSET=S\nLATER\n*NSET, NSET=LATER, INSTANCE=J\nTOP\n",
        ):
            self.assertEqual(self.members(text, "S"), [13, 14, 15, 16], text)
        self.assertEqual(
            self.members("*ELSET, ELSET=S\nI.CUBE, J.CUBE\n", "S", "element_sets"), [1, 2]
        )
        self.assertEqual(self.members("*NSET, NSET=S, ELSET=J.CUBE\n", "S"), list(range(9, 17)))
        self.assertEqual(
            self.members("*NODE, NSET=S\n1, 9., 9., 9.\n2, 9., 9., 8.\n", "S"), [21, 22]
        )

    def test_surfaces_of_instances(self):
        inside = "*SURFACE, NAME=U\nJ.CUBE, S2\n*SURFACE, NAME=V, COMBINE=UNION\nU, I.LOWER\n"
        inside += "*SURFACE, NAME=W, COMBINE=DIFFERENCE\nV, U\n"
        part = "*SURFACE, NAME=LOWER\nCUBE, S1\n"
        model, journal = model_of(assembly(self.TWO, part, inside))
        self.assertEqual(journal.refusals, [])
        found = {
            key: list(zip(one.elements.tolist(), one.faces.tolist()))
            for key, one in model.surfaces.items()
        }
        self.assertEqual(found["U"], [(2, 1)])
        self.assertEqual(found["V"], [(2, 1), (1, 0)])
        self.assertEqual(found["W"], found["I.LOWER"])
        self.assertEqual(found["J.LOWER"], [(2, 0)])

    def test_elements_between_instances(self):
        inside = "*ELEMENT, TYPE=SPRINGA, ELSET=S\n1, I.6, J.5\n*SPRING, ELSET=S\n\n7.\n"
        one = Imported(assembly(self.TWO, inside=inside))
        (spring,) = one.options["spring"].values()
        self.assertEqual(spring, {"from": "node_I.6", "to": "node_J.5", "stiffness": 7.0})

    def test_free_faces(self):
        """A surface without labels of faces has those that no other cell has."""
        second = "*NODE\n11, 0., 0., 2.\n12, 1., 0., 2.\n13, 1., 1., 2.\n14, 0., 1., 2.\n"
        second += "*ELEMENT, TYPE=C3D8, ELSET=CUBE\n2, 5, 6, 7, 8, 11, 12, 13, 14\n"
        model, _ = model_of(CUBE + second + "*SURFACE, NAME=S\nCUBE\n*SURFACE, NAME=T\n1\n")
        faces = [(1, face) for face in (0, 2, 3, 4, 5)]
        one = model.surfaces["T"]
        self.assertEqual(list(zip(one.elements.tolist(), one.faces.tolist())), faces)
        self.assertEqual(len(model.surfaces["S"].faces), 10)

    def test_numbers_do_not_reach_other_instances(self):
        """The numbers 9 to 16 of I would be those of J, if they were not named before."""
        two, everything = self.TWO, "*NSET, NSET=MANY, GENERATE\n1, 16\n"
        model, _ = model_of(assembly(two, everything))
        self.assertEqual(model.node_sets.members("I.MANY").tolist(), list(range(1, 17)))
        self.assertEqual(model.blocks[0].nodes[1].tolist(), list(range(21, 29)))
        for part, inside, reason in (
            ("", "*NSET, NSET=S, INSTANCE=I\n9\n", "*NSET: there is no node 9 of I"),
            ("", "*NSET, NSET=S\nI.9\n", "*NSET: there is no node 9 of I"),
            ("", "*ELSET, ELSET=S, INSTANCE=I\n2\n", "*ELSET: there is no element 2 of I"),
            ("", "*NSET, NSET=S, INSTANCE=J\n0\n", "node 0: numbers are 1 or more"),
            ("*NSET, NSET=S\n0\n", "", "node 0: numbers are 1 or more"),
            ("*ELGEN\n1, 2, 4\n", "", "element 2 of I: there is no node 9 of I"),
            (
                "*NCOPY, CHANGE NUMBER=-4, OLD SET=TOP, SHIFT\n1.\n"
                "*NCOPY, CHANGE NUMBER=-8, OLD SET=TOP, SHIFT\n1.\n",
                "",
                "node -3: numbers are 1 or more",
            ),
        ):
            rows = refused(assembly(two, part, inside))
            self.assertTrue(any(reason in row for row in rows), (part, inside, rows))

    def test_structures_that_are_wrong(self):
        part = "*PART, NAME=P\n*END PART\n"
        for text, reason in (
            ("*PART\n*END PART\n", "*PART: NAME= is missing"),
            (part + part, "the part 'P' is defined twice"),
            ("*END PART\n", "there is no *PART before it"),
            (part + "*ASSEMBLY\n" + instance("I", part="Q"), "there is no part 'Q'"),
            (part + "*ASSEMBLY\n" + 2 * instance("I"), "the instance 'I' is defined twice"),
            (part + instance("I"), "this card is outside of *ASSEMBLY"),
            ("*PART, NAME=P\n*MATERIAL, NAME=M\n*END PART\n", "this card belongs to the model"),
            ("*PART, NAME=P\n", "no *END PART follows"),
            (part + "*ASSEMBLY\n" + instance("I", "1., 0., 0., 0., 0., 0., 9.\n"), "a translation"),
            (
                part + "*ASSEMBLY\n" + instance("I", "1.\n0., 0., 0., 9.\n"),
                "two points of the axis",
            ),
            (
                part + "*ASSEMBLY\n" + instance("I", "\n1., 0., 0.\n1, 0, 0, 1, 0, 0, 9\n"),
                "coincide",
            ),
            (part + "*ASSEMBLY\n*NSET, NSET=S, INSTANCE=K\n1\n", "there is no instance 'K'"),
            ("*PART, NAME=P, LIBRARY=x\n*END PART\n", "*PART, LIBRARY: this parameter"),
        ):
            rows = refused(text + CUBE)
            self.assertTrue(any(reason in row for row in rows), (text, rows))
        (row,) = refused(assembly(self.TWO, inside="*EQUATION\n1\nJ.99, 1, 1.\n"))
        self.assertIn("there is no node 99 of J", row)
        one = Imported(assembly(self.TWO) + "*PART, NAME=SPARE\n*NODE\n1, 0.\n*END PART\n")
        self.assertIn("no instance has this part", one.account)


class FormOfCae(unittest.TestCase):
    def test_a_brake_is_translated(self):
        one = Imported(brake_of_cae.TEXT)
        options = one.options
        self.assertEqual(list(options["material"]), ["Disc-1", "Pad-1"])
        self.assertEqual(options["material"]["Disc-1"]["rayleigh_mass"], 1.0)
        self.assertEqual(options["motion"]["Disc-1"]["speed"], 3.0)
        (contact,) = options["contact"].values()
        self.assertEqual((contact["pad"], contact["disc"]), ("Pad-1.Low", "Disc-1.Top"))
        self.assertEqual(contact["role"], "sliding")
        self.assertEqual(options["spring"]["element_1"]["from"], "node_Disc-1.30")
        self.assertEqual(options["coupling"]["Constraint-1"]["reference"], "reference_1")
        held = {"clamped": "xy", "clamped_rotation": "xyz"}
        self.assertEqual(options["constraint"]["reference_1"], held)
        self.assertEqual(options["flutter"]["friction"], "0.0:0.4:0.04")
        self.assertEqual(len(one.groups["Disc-1"]), 16)
        outcomes = {entry.status for entry in one.journal.entries.values()}
        self.assertEqual(outcomes, {"used", "translated", "not used"})


class Generated(unittest.TestCase):
    GRID = "*NODE\n1, 0., 0., 0.\n4, 3., 0., 0.\n21, 0., 2., 0.\n24, 3., 2., 0.\n"
    GRID += "*NGEN, NSET=A\n1, 4\n*NGEN, NSET=B\n21, 24\n*NFILL, NSET=FLOOR\nA, B, 2, 10\n"
    GRID += "*NCOPY, CHANGE NUMBER=100, OLD SET=FLOOR, NEW SET=UPPER, SHIFT, MULTIPLE=2\n"
    GRID += "0., 0., 1.5\n0., 0., 0., 0., 0., 1., 0.\n"
    GRID += "*ELEMENT, TYPE=C3D8I, ELSET=FIRST\n1, 1, 2, 12, 11, 101, 102, 112, 111\n"
    GRID += "*ELGEN, ELSET=LAYER\n1, 3, 1, 1, 2, 10, 3\n"
    GRID += "*ELCOPY, OLD SET=LAYER, NEW SET=TOP, ELEMENT SHIFT=50, SHIFT NODES=100\n"

    def test_a_block_from_four_nodes(self):
        """3 x 2 x 2 cells fill a box of 3 x 2 x 3, each node at an intersection."""
        model, journal = model_of(self.GRID)
        self.assertEqual(journal.refusals, [])
        self.assertEqual(len(model.nodes.numbers), 4 * 3 * 3)
        numbers = model.nodes.numbers
        layer, rest = numbers // 100, numbers % 100
        wanted = np.column_stack([(rest - 1) % 10, rest // 10, 1.5 * layer])
        self.assertLess(np.max(np.abs(model.nodes.coordinates - wanted)), 1e-15)
        (block,) = model.blocks
        self.assertEqual(sorted(block.numbers), [1, 2, 3, 4, 5, 6, 51, 52, 53, 54, 55, 56])
        corners = model.nodes.at(block.nodes.ravel()).reshape(-1, 8, 3)
        low = corners.min(axis=1)
        self.assertEqual(len(np.unique(low, axis=0)), 12)
        self.assertTrue(np.allclose(corners - low[:, None], (corners - low[:, None])[0], 0, 1e-14))
        self.assertEqual(model.element_sets.members("TOP").tolist(), [51, 52, 53, 54, 55, 56])

    def test_copies_are_moved_and_turned(self):
        text = (
            "*NODE, NSET=N\n1, 1., 0., 0.\n*NCOPY, CHANGE NUMBER=1, OLD SET=N, SHIFT, MULTIPLE=3\n"
        )
        model, _ = model_of(text + "0., 0., 2.\n0., 0., 0., 0., 0., 1., 90.\n")
        wanted = [[1, 0, 0], [0, 1, 2], [-1, 0, 4], [0, -1, 6]]
        self.assertLess(np.max(np.abs(model.nodes.coordinates - wanted)), 1e-15)

    def test_generators_that_are_wrong(self):
        for card, reason in (
            ("*NGEN, LINE=C\n1, 4\n", "*NGEN, LINE: this parameter is not supported"),
            ("*NFILL\nA, FLOOR, 2, 10\n", "different numbers of nodes"),
            ("*NCOPY, CHANGE NUMBER=1, OLD SET=A\n", "only copies by SHIFT"),
            ("*NMAP, NSET=A\n1.\n", "mapped nodes are not supported"),
            ("*ELGEN\n99, 2\n", "there is no element 99"),
            ("*ELCOPY, OLD SET=NONE, ELEMENT SHIFT=1, SHIFT NODES=1\n", "no element set 'NONE'"),
        ):
            rows = refused(self.GRID + card)
            self.assertTrue(any(reason in row for row in rows), (card, rows))


if __name__ == "__main__":
    unittest.main()
