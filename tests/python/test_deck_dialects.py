#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Dialects of decks: how they are detected, and cards that Abaqus and CalculiX read differently."""
import sys
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/deck")]
sys.dont_write_bytecode = True
import numpy as np
from small_decks import CUBE, Imported, cube, numbers, refused

from squeal.deck.case.attachments import of_equal_weight
from squeal.deck.case.weights import shares
from squeal.deck.cells import HEX20, TET10

LOOSE = "*NODE\n20, 0.5, 0.5, 3.\n21, 6., 0., 0.\n*NSET, NSET=R\n20\n"
UP = "*SURFACE, NAME=UP\nCUBE, S2\n"
COUPLING = "*COUPLING, CONSTRAINT NAME=C, REF NODE=R, SURFACE=UP\n"
DCOUP = "*ELEMENT, TYPE=DCOUP3D, ELSET=D\n9, 20\n*DISTRIBUTING COUPLING, ELSET=D\n5, 1.\n6, 3.\n"
DAMPING = "*MATERIAL, NAME=OTHER\n*DAMPING, ALPHA=2., BETA=1.E-6\n"
FREQUENCY = "*STEP, PERTURBATION\n*FREQUENCY\n4\n*END STEP\n"
DIFFERENT = "Abaqus and CalculiX read it differently"


class Detection(unittest.TestCase):
    def dialect(self, text, **words):
        try:
            account = Imported(text, **words).account
        except Exception as error:  # the choice is also in the message of the folder
            raise AssertionError(str(error)) from error
        return account.split("Read as a deck of ")[1].split(". Cards")[0]

    def test_marks(self):
        bricks = CUBE.split("*ELEMENT")[0]
        for model, step, wanted in (
            ("", "", "Abaqus or CalculiX"),
            ("*RIGID BODY, NSET=TOP, REF NODE=20, ROT NODE=21\n", "", "CalculiX"),
            ("*RIGID BODY, PIN NSET=TOP, REF NODE=20\n", "", "Abaqus"),
            ("*NODE\n22, 9.\n*NGEN\n21, 22\n", "", "Abaqus"),
            ("*SYSTEM\n", "", "Abaqus"),
            ("*KINEMATIC COUPLING, REF NODE=20\nTOP\n", "", "Abaqus"),
            ("", "*BOUNDARY\nTOP, XSYMM\n", "Abaqus"),
            ("", "*NODE FILE, OUTPUT=3D\nU\n", "CalculiX"),
            ("", "*OUTPUT, FIELD\n", "Abaqus"),
            ("*NSET, NSET=S, INTERNAL\n1\n", "", "Abaqus"),
            (
                "*RIGID BODY, NSET=TOP, REF NODE=20, ROT NODE=21\n",
                "*OUTPUT\n",
                "Abaqus or CalculiX",
            ),
        ):
            self.assertEqual(self.dialect(cube(LOOSE + model, step)), wanted, model + step)
        self.assertTrue(bricks)

    def test_types_of_elements(self):
        text = cube().replace("TYPE=C3D8", "TYPE=C3D8H")
        self.assertEqual(self.dialect(text), "Abaqus")

    def test_words_in_comments_and_names_are_no_marks(self):
        text = cube("** *PART\n*NSET, NSET=ENCASTRE\n1\n", "*CLOAD\nENCASTRE, 1, 1.\n")
        self.assertEqual(self.dialect(text), "Abaqus or CalculiX")

    def test_a_given_dialect_prevails(self):
        text = cube("*SYSTEM\n")
        self.assertEqual(self.dialect(text, dialect="calculix"), "CalculiX")
        self.assertIn("(Abaqus)", Imported(text).text)

    def test_both_are_named(self):
        text = cube(LOOSE + "*RIGID BODY, NSET=TOP, REF NODE=20, ROT NODE=21\n", "*OUTPUT\n")
        choice = Imported(text).journal.choices[0]
        self.assertRegex(choice, r"Abaqus has \*OUTPUT \(.*\); CalculiX has \*RIGID BODY, NSET")


class Different(unittest.TestCase):
    """Cards that are refused unless the dialect is known."""

    def test_undecided_decks(self):
        law = "*SURFACE INTERACTION, NAME=I\n*FRICTION\n0.3, 5000.\n"
        for text, card in (
            (cube(LOOSE + UP + COUPLING + "*DISTRIBUTING\n"), "*DISTRIBUTING"),
            (cube(LOOSE + DCOUP), "*DISTRIBUTING COUPLING"),
            (cube(LOOSE + "*MPC\nBEAM, 5, 20\n"), "*MPC"),
            (cube(DAMPING), "*DAMPING"),
            (cube(law), "*FRICTION"),
            (cube(after=FREQUENCY), "*FREQUENCY"),
        ):
            found = [row for row in refused(text) if DIFFERENT in row]
            self.assertEqual([row.split(": ")[1] for row in found], [card])

    def test_distributing(self):
        text = cube(LOOSE + UP + COUPLING + "*DISTRIBUTING\n1, 6\n")
        (options,) = Imported(text, dialect="abaqus").options["coupling"].values()
        self.assertEqual(
            options, {"reference": "reference_20", "nodes": "UP", "kind": "distributed"}
        )
        self.assertIn("CalculiX distributes forces", refused(text, dialect="calculix")[0])
        for old, new, reason in (
            ("1, 6", "1, 3", "whose rotations are free"),
            ("DISTRIBUTING", "DISTRIBUTING, WEIGHTING METHOD=X", "WEIGHTING METHOD=X is not"),
            ("DISTRIBUTING", "DISTRIBUTING, COUPLING=STRUCTURAL", "only COUPLING=CONTINUUM"),
            ("R, SURFACE", "5, SURFACE", "the reference node 5 belongs to solid cells"),
        ):
            self.assertIn(reason, refused(text.replace(old, new), dialect="abaqus")[0])

    def test_weights_of_distributing_couplings(self):
        """Areas of the faces next to a node, times a function of its distance over the largest."""
        other = "*NODE\n9, 3., 0., 1.\n10, 3., 1., 1.\n11, 3., 0., 0.\n12, 3., 1., 0.\n"
        other += "*ELEMENT, TYPE=C3D8, ELSET=CUBE\n2, 2, 11, 12, 3, 6, 9, 10, 7\n"
        place = np.array([0.0, 0.5, 3.0])
        nodes = {5: (0, 0), 6: (1, 0), 7: (1, 1), 8: (0, 1), 9: (3, 0), 10: (3, 1)}
        areas = {5: 0.25, 6: 0.75, 7: 0.75, 8: 0.25, 9: 0.5, 10: 0.5}
        away = {at: np.linalg.norm([*one, 1] - place) for at, one in nodes.items()}
        for method, function in (
            ("UNIFORM", lambda r: 1),
            ("LINEAR", lambda r: 1 - r),
            ("QUADRATIC", lambda r: 1 - r * r),
            ("CUBIC", lambda r: 1 - 3 * r**2 + 2 * r**3),
        ):
            card = f"*DISTRIBUTING, WEIGHTING METHOD={method}\n"
            loose = LOOSE.replace("0.5, 0.5, 3.", "0., 0.5, 3.")
            one = Imported(cube(other + loose + UP + COUPLING + card), dialect="abaqus")
            largest = max(away.values())
            wanted = {at: areas[at] * function(away[at] / largest) for at in nodes}
            self.compare_weights(one, {at: value for at, value in wanted.items() if value > 1e-9})

    def compare_weights(self, one, wanted):
        (coupling,) = one.options["coupling"].values()
        groups = coupling["nodes"].split(",")
        weights = numbers(coupling.get("weights", ",".join(["1"] * len(groups))))
        found = {}
        for group, weight in zip(groups, weights):
            for node in one.groups[group]:
                found[node] = found.get(node, 0.0) + weight
        self.assertEqual(sorted(found), sorted(wanted))
        scale = max(found.values()) / max(wanted.values())
        for node, weight in wanted.items():
            self.assertAlmostEqual(found[node] / scale, weight, delta=1e-9)

    def test_areas_of_faces_with_nodes_on_edges(self):
        """A triangle has 1/12 of its area at a corner and 1/4 in the middle of an edge; a square
        1/24 and 5/24."""
        tetrahedron = np.array([[0, 0, 0], [2, 0, 0], [0, 3, 0], [0, 0, 5.0]])
        square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
        cube_corners = np.array([[x, y, z] for z in (0, 1) for x, y in square], float)
        for shape, corners, areas, corner, middle in (
            (
                TET10,
                tetrahedron,
                (3, 5, np.sqrt(15**2 + 10**2 + 6**2) / 2, 7.5),
                1 / 12,
                1 / 4,
            ),
            (HEX20, cube_corners, (1,) * 6, 1 / 24, 5 / 24),
        ):
            edges = [corners[list(edge)].mean(axis=0) for edge in shape.edges]
            nodes = np.vstack([corners, edges])
            for face, area in zip(shape.faces, areas):
                half = len(face) // 2
                wanted = area * np.repeat([corner, middle], half)
                self.assertTrue(np.allclose(shares(nodes[list(face)][None])[0], wanted, 1e-14, 0))

    def test_areas_of_any_faces(self):
        """Without nodes on edges: the integrals of the shape functions of a trapezium, by hand. On
        a cylinder of radius 1, a piece of 30 by 30 degrees has its area up to that of parabolas."""
        trapezium = np.array([[[0, 0, 0], [2, 0, 0], [1, 1, 0], [0, 1, 0]]], float)
        self.assertTrue(np.allclose(shares(trapezium)[0] * 12, [5, 5, 4, 4], 1e-14, 0))
        triangle = np.array([[0, 0], [1, 0], [0, 1], [0.5, 0], [0.5, 0.5], [0, 0.5]])
        square = [[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0], [1, 0.5], [0.5, 1], [0, 0.5]]
        for plane, area in ((triangle, 1 / 2), (np.array(square), 1)):
            angle, height = np.pi / 6 * plane.T
            face = np.stack([np.cos(angle), np.sin(angle), height], axis=1)
            found = shares(face[None])[0] / (area * (np.pi / 6) ** 2)
            self.assertLess(abs(found.sum() - 1), 1e-4)
            self.assertGreater(found.min(), 1 / 30)

    def test_many_weights_are_sums_of_powers_of_two(self):
        nodes = 100 + np.arange(50)
        weights = np.random.default_rng(5).random(50) + 0.1
        found = np.zeros(50)
        for part, weight in of_equal_weight(nodes, weights):
            found[part - 100] += weight
        self.assertLess(np.max(np.abs(found / found.max() - weights / weights.max())), 1e-9)
        self.assertEqual(len(list(of_equal_weight(nodes, np.repeat([1.0, 2.0], 25)))), 2)

    def test_weights_of_nodes(self):
        surface = "*SURFACE, NAME=UP, TYPE=NODE\n5, {}\n6, 2.\n7, 2.\n"
        text = cube(LOOSE + surface.format("2.") + COUPLING + "*DISTRIBUTING\n")
        self.compare_weights(Imported(text, dialect="abaqus"), {5: 1, 6: 1, 7: 1})
        text = cube(LOOSE + surface.format("3.") + COUPLING + "*DISTRIBUTING\n")
        self.assertIn("nodes with different areas", refused(text, dialect="abaqus")[0])
        text = cube(LOOSE + DCOUP.replace("6, 3.", "6, 3.\n8, 2."))
        self.compare_weights(Imported(text, dialect="abaqus"), {5: 1, 6: 3, 8: 2})
        rows = refused(text.replace("9, 20", "9, 1"), dialect="abaqus")
        self.assertIn("the reference node 1 belongs to solid cells", rows[0])

    def test_damping(self):
        text = cube().replace("*DENSITY", "*DAMPING, ALPHA=2., BETA=1.E-6\n*DENSITY")
        body = Imported(text, dialect="abaqus").options["material"]["CUBE"]
        self.assertEqual((body["rayleigh_mass"], body["rayleigh_stiffness"]), (2.0, 1e-6))
        one = Imported(text, dialect="calculix")
        self.assertNotIn("rayleigh", one.text)
        self.assertEqual(one.remarks("DAMPING")[0], "not used")
        text = text.replace("ALPHA=2.", "STRUCTURAL=0.01")
        self.assertIn("structural damping needs a frequency", refused(text, dialect="abaqus")[0])

    def test_perturbations(self):
        """Without NLGEOM, Abaqus has no stress in the stiffness; CalculiX has."""
        text = cube(after=FREQUENCY)
        self.assertNotIn("prestress", Imported(text, dialect="abaqus").text)
        self.assertIn("prestress: on", Imported(text, dialect="calculix").text)

    def test_tolerances_of_ties(self):
        """CalculiX ties up to 0.0071 here, Abaqus up to 5 % of the edge 1."""
        brick = "*NODE\n41, 0.25, 0.5, {}\n42, .75, .5, 1.2\n43, .75, 1.5, 1.2\n44, .25, 1.5, 1.2\n"
        brick += "*ELEMENT, TYPE=C3D4, ELSET=CUBE\n2, 41, 42, 43, 44\n*ELSET, ELSET=LOWER\n1\n"
        tie = "*SURFACE, NAME=UP\nLOWER, S2\n*NSET, NSET=N\n41\n"
        tie += "*SURFACE, NAME=N, TYPE=NODE\nN\n*TIE, NAME=T\nN, UP\n"
        for height, tied in ((1.005, (1, 1)), (1.04, (0, 1)), (1.06, (0, 0))):
            text = cube(brick.format(height) + tie)
            for dialect, count in zip(("calculix", "abaqus"), tied):
                one = Imported(text, dialect=dialect)
                self.assertIn(f"| T | nodes | {count} | {1 - count} |", one.account)
            if tied == (0, 1):
                self.assertIn("tie different nodes", refused(text)[0])
            else:
                self.assertIn(f"| T | nodes | {tied[0]} |", Imported(text).account)


class Readings(unittest.TestCase):
    """Cards as Abaqus reads them."""

    def read(self, model="", step="", **words):
        return Imported(cube(model, step), dialect="abaqus", **words)

    def test_types_of_elements(self):
        for kind, text in (
            *(("C3D8R", "hourglass"), ("C3D8H", "hybrid"), ("C3D8T", "mechanical part")),
            ("C3D8IH", "hybrid"),
        ):
            deck = cube().replace("TYPE=C3D8", f"TYPE={kind}")
            one = Imported(deck, dialect="abaqus")
            self.assertTrue(
                any(f"{kind}: " in choice and text in choice for choice in one.journal.choices)
            )
            modes = one.options.get("elasticity", {}).get("incompatible_modes")
            self.assertEqual(modes, None if kind in ("C3D8R", "C3D8IH") else "none")
        deck = cube().replace("TYPE=C3D8", "TYPE=C3D8R")
        self.assertIn("hourglass", refused(deck, dialect="calculix")[0])

    def test_loads_of_bodies(self):
        """Forces per volume over the density, 7.8e-9; without a set on all cells."""
        one = self.read(step="*DLOAD\n, GRAV, 5., 0., 0., -2.\nCUBE, BX, 7.8E-9\n")
        self.assertEqual(numbers(one.options["load"]["CUBE"]["acceleration"]), [1, 0, -5])
        one = self.read(step="*DLOAD\nCUBE, CENT, 7.02E-8, 0., 0., 0., 0., 0., 1.\n")
        self.assertAlmostEqual(float(one.options["load"]["CUBE"]["spin"]), 3, delta=1e-14)
        rows = refused(cube(step="*DLOAD\nCUBE, ROTA, 1.\nCUBE, HP2, 1.\n"), dialect="abaqus")
        self.assertIn("*DLOAD, ROTA: the load ROTA is not supported", rows[0])

    def test_supports_by_name(self):
        one = self.read(step="*BOUNDARY\nTOP, ZSYMM\n")
        self.assertEqual(one.options["constraint"]["TOP"], {"clamped": "z"})
        self.assertIn("has no rotations: not held", one.remarks("BOUNDARY")[1] + one.account)
        step = "*BOUNDARY\nR, ENCASTRE\n"
        one = self.read(LOOSE + "*RIGID BODY, REF NODE=R, TIE NSET=TOP\n", step)
        held = {"clamped": "xyz", "clamped_rotation": "xyz"}
        self.assertEqual(one.options["constraint"]["reference_20"], held)

    def test_a_radius_of_influence(self):
        """The corners 5 and 6 of the top are at 1 from (0.5, 0, 1.866), the others at 1.5."""
        cards = "*NODE\n20, 0.5, 0., 1.8660\n*NSET, NSET=R\n20\n" + UP
        cards += COUPLING.replace("UP\n", "UP, INFLUENCE RADIUS=1.1\n") + "*KINEMATIC\n1, 6\n"
        one = self.read(cards)
        self.assertEqual(one.groups[one.options["coupling"]["C"]["nodes"]], [5, 6])

    def test_turned_axes_of_materials(self):
        """Axes are turned about one of them: plies of a wound tube."""
        law = "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n3.,2.,1.,.1,.2,.3,4.,5.,\n6.\n"
        text = cube().replace("*ELASTIC\n210000., 0.3\n", law)
        text = text.replace("MATERIAL=STEEL", "MATERIAL=STEEL, ORIENTATION=PLY")
        text += "*ORIENTATION, NAME=PLY, SYSTEM=CYLINDRICAL\n2., 0., 0., 2., 0., 1.\n1, 55.\n"
        options = Imported(text, dialect="abaqus").options
        self.assertEqual(options["material"]["CUBE"]["frame"], "PLY")
        frame = options["frame"]["PLY"]
        self.assertEqual((frame["turn"], frame["turn_about"]), (55.0, "x"))
        self.assertEqual((frame["origin"], frame["axis"]), ("2.0,0.0,0.0", "0.0,0.0,1.0"))

    def test_rotations_of_coupled_reference_nodes(self):
        """A loose node with a mass follows, with its rotations unless it is pinned."""
        cards = LOOSE + "*NSET, NSET=PART\n5, 6, 7, 21\n*ELEMENT, TYPE=MASS, ELSET=M\n9, 21\n"
        cards += "*MASS, ELSET=M\n1.\n"
        tied = self.read(cards + "*RIGID BODY, REF NODE=R, TIE NSET=PART\n").options
        self.assertNotIn("reference_21", tied["constraint"])
        self.assertNotIn("pinned", tied["coupling"]["reference_20"])
        pinned = self.read(cards + "*RIGID BODY, REF NODE=R, PIN NSET=PART\n").options
        self.assertEqual(pinned["constraint"]["reference_21"], {"clamped_rotation": "xyz"})
        self.assertIs(pinned["coupling"]["reference_20"]["pinned"], True)
        old = "*KINEMATIC COUPLING, REF NODE=20\nPART, 1, 4\n"
        rows = refused(cube(cards + old), dialect="abaqus")
        self.assertIn("some, but not all, rotations", rows[0])

    def test_sections_of_one_body(self):
        """Cells that share nodes are one body; loads on one of them divide it."""
        second = "*NODE\n11, 0., 0., 2.\n12, 1., 0., 2.\n13, 1., 1., 2.\n14, 0., 1., 2.\n"
        second += "*ELEMENT, TYPE=C3D8, ELSET=UPPER\n2, 5, 6, 7, 8, 11, 12, 13, 14\n"
        second += "*SOLID SECTION, ELSET=UPPER, MATERIAL=STEEL\n*ELSET, ELSET=WHOLE\nCUBE, UPPER\n"
        one = self.read(second, "*DLOAD\nWHOLE, GRAV, 1., 0., 0., 1.\n")
        self.assertEqual(one.options["material"]["WHOLE"], {"sections": "CUBE,UPPER"})
        self.assertEqual(one.options["load"], {"WHOLE": {"acceleration": "0.0,0.0,1.0"}})
        one = self.read(second, "*DLOAD\nUPPER, GRAV, 1., 0., 0., 1.\n")
        self.assertEqual(set(one.options["material"]), {"CUBE", "UPPER"})

    def test_ties(self):
        ties = UP + "*SURFACE, NAME=DOWN\nCUBE, S1\n"
        ties += "*TIE, NAME=T, TYPE=SURFACE TO SURFACE, NO ROTATION\nUP, DOWN\n"
        one = self.read(ties)
        self.assertEqual(one.options["tie"], {"T": {"slave": "UP", "master": "DOWN"}})
        self.assertTrue(any("half their size" in choice for choice in one.journal.choices))

    def test_bolts(self):
        """The force acts on the side of the elements of the surface, along the normal."""
        second = "*NODE\n11, 0., 0., 2.\n12, 1., 0., 2.\n13, 1., 1., 2.\n14, 0., 1., 2.\n"
        second += "*ELEMENT, TYPE=C3D8, ELSET=CUBE\n2, 5, 6, 7, 8, 11, 12, 13, 14\n"
        second += "*ELSET, ELSET=LOWER\n1\n*SURFACE, NAME=CUT\nLOWER, S2\n"
        card = "*PRE-TENSION SECTION, SURFACE=CUT, NODE=21\n{}"
        load = "*CLOAD\n21, 1, {}\n"
        for normal, force, wanted in (
            ("", "6.", [0, 0, 1]),
            ("0., 0., 1.\n", "6.", [0, 0, 1]),
            ("0., 0., -1.\n", "-6.", [0, 0, -1]),
        ):
            one = self.read(LOOSE + second + card.format(normal), load.format(force))
            bolt = one.options["bolt"]["CUT"]
            self.assertEqual((bolt["section"], bolt["force"]), ("CUT", 6.0))
            self.assertEqual(numbers(bolt["axis"]), wanted)
            self.assertTrue(any("keeps its length" in choice for choice in one.journal.choices))
        text = LOOSE + second + card.format("")
        for step, reason in (
            (load.format("-6."), "presses its two sides together"),
            ("", "no *CLOAD gives the tension"),
            ("*CLOAD\n21, 2, 1.\n", "the tension of a bolt is component 1"),
            ("*BOUNDARY\n21, 1, 1, 0.1\n", "bolts with a given elongation"),
            ("*BOUNDARY, FIXED\nTOP, 1\n", "values that earlier steps have reached"),
        ):
            rows = refused(cube(text, step), dialect="abaqus")
            self.assertTrue(any(reason in row for row in rows), (step, rows))
        rows = refused(cube(text.replace("NODE=21", "NODE=5"), load.format("6.")), dialect="abaqus")
        self.assertTrue(any("the node belongs to a body" in row for row in rows), rows)
        rows = refused(cube(text + card.format(""), load.format("6.")), dialect="abaqus")
        self.assertTrue(any("another bolt has the same node" in row for row in rows), rows)

    def test_springs(self):
        """A spring between components: the displacement x of a further node is its elongation."""
        cards = "*ELEMENT, TYPE=SPRING2, ELSET=S\n9, 5, 7\n*SPRING, ELSET=S\n1, 3\n50.\n"
        cards += "*ELEMENT, TYPE=DASHPOT1, ELSET=D\n10, 6\n*DASHPOT, ELSET=D\n2\n4.\n"
        one = self.read(cards)
        equation = one.options["equation"]["element_9"]
        self.assertEqual(equation, "reference_element_9:x - node_5:x + node_7:z = 0")
        spring = {"from": "reference_element_9", "stiffness": "50.0,0.0,0.0"}
        self.assertEqual(one.options["bushing"]["element_9"], spring)
        dashpot = {"from": "node_6", "damping": "0.0,4.0,0.0"}
        self.assertEqual(one.options["bushing"]["element_10"], dashpot)
        for data, reason in (("1\n50.\n", "two components"), ("50.\n", "two components")):
            rows = refused(cube(cards.replace("1, 3\n50.\n", data)), dialect="abaqus")
            self.assertIn(reason, rows[1])

    def test_inertias(self):
        cards = LOOSE + "*RIGID BODY, REF NODE=R, TIE NSET=TOP\n"
        cards += "*ELEMENT, TYPE=MASS, ELSET=M\n9, 20\n*MASS, ELSET=M\n2.\n"
        turn = "*ELEMENT, TYPE=ROTARYI, ELSET=I\n10, 20\n*ROTARY INERTIA, ELSET=I\n1., 2., 3.{}\n"
        mass = self.read(cards + turn.format("")).options["mass"]["reference_20"]
        self.assertEqual(mass["total"], 2.0)
        self.assertEqual(numbers(mass["inertia"]), [1, 2, 3, 0, 0, 0])
        mass = self.read(cards + turn.format(", .1, .2, .3")).options["mass"]["reference_20"]
        self.assertEqual(numbers(mass["inertia"]), [1, 2, 3, 0.1, 0.2, 0.3])
        rows = refused(cube(cards + turn.format(", 5.")), dialect="abaqus")
        self.assertIn("a negative principal moment", rows[1])
        rows = refused(cube(cards.split("*ELEMENT")[0] + turn.format("")), dialect="abaqus")
        self.assertIn("*ROTARY INERTIA: node 20 has no *MASS", rows[0])


if __name__ == "__main__":
    unittest.main()
