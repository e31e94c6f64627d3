#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Joints of decks: equations, couplings, rigid bodies, springs, masses and ties."""
import sys
import unittest
from pathlib import Path

import numpy as np

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/deck")]
sys.dont_write_bytecode = True
from small_decks import Imported, cube, refused, terms


class Joints(unittest.TestCase):
    LOOSE = "*NODE\n20, 5., 0., 0.\n21, 6., 0., 0.\n"

    def test_equations_with_loose_nodes_and_transformed_axes(self):
        axes = "*TRANSFORM, NSET=TOP, TYPE=R\n0., 1., 0., -1., 0., 0.\n"
        one = Imported(cube(self.LOOSE + axes + "*EQUATION\n2\n20, 1, 2., 5, 1, -3.\n"))
        (text,) = one.options["equation"].values()
        # The first axis at node 5 is y.
        self.assertEqual(terms(text), {"reference_20:x": 2, "node_5:y": -3})
        held = one.options["constraint"]["reference_20"]
        self.assertEqual(held, {"clamped": "yz", "clamped_rotation": "xyz"})
        self.assertNotIn("reference_21", one.options["reference"])

    def test_equations_of_sets_are_paired(self):
        one = Imported(
            cube(
                "*EQUATION\n2\nTOP, 3, 1., 5, 3, -1.\n".replace("TOP", "PART")
                + "*NSET, NSET=PART\n6, 7\n"
            )
        )
        found = [terms(text) for text in one.options["equation"].values()]
        self.assertEqual(found, [{f"node_{at}:z": 1, "node_5:z": -1} for at in (6, 7)])

    def test_wrong_equations(self):
        for card, reason in (
            ("3\n5, 1, 1., 6, 1, 1.\n", "an equation of 3 terms has 9 fields"),
            ("1\n5, 1, 0.\n", "all coefficients of an equation are zero"),
            ("1\n5, 9, 1.\n", "components are 1 to 6"),
            ("1\n99, 1, 1.\n", "there is no node 99"),
        ):
            self.assertIn(reason, refused(cube("*EQUATION\n" + card))[0])

    def test_a_rigid_body_with_a_moment(self):
        body = "*RIGID BODY, NSET=TOP, REF NODE=20, ROTNODE=21\n"
        step = "*CLOAD\n21, 2, 4.\n20, 1, 5.\n*BOUNDARY\n21, 3, 3, 0.1\n"
        one = Imported(cube(self.LOOSE + body, step))
        options = one.options
        self.assertEqual(options["coupling"]["reference_20"]["nodes"], "TOP")
        self.assertEqual(options["reference"]["reference_20"]["position"], "5.0,0.0,0.0")
        load = {"force": "5.0,0.0,0.0", "moment": "0.0,4.0,0.0"}
        self.assertEqual(options["load"]["reference_20"], load)
        held = {"clamped_rotation": "z", "angle": "0.0,0.0,0.1"}
        self.assertEqual(options["constraint"]["reference_20"], held)

    def test_couplings(self):
        card = "*SURFACE, NAME=UP\nCUBE, S2\n"
        card += "*COUPLING, REF NODE=20, SURFACE=UP, CONSTRAINT NAME=HUB{}\n"
        axes = "*ORIENTATION, NAME=AXES, SYSTEM=CYLINDRICAL\n0., 0., 0., 0., 0., 2.\n"
        text = self.LOOSE + axes + card.format(", ORIENTATION=AXES") + "*KINEMATIC\n1\n3, 3\n"
        options = Imported(cube(text, "*CLOAD\n20, 5, 4.\n*BOUNDARY\n20, 6\n")).options
        wanted = {"reference": "reference_20", "nodes": "UP", "components": "xz", "frame": "AXES"}
        self.assertEqual(options["coupling"], {"HUB": wanted})
        self.assertEqual(options["frame"]["AXES"]["axis"], "0.0,0.0,2.0")
        self.assertEqual(options["load"], {"reference_20": {"moment": "0.0,4.0,0.0"}})
        self.assertEqual(options["constraint"]["reference_20"], {"clamped_rotation": "z"})
        text = cube(self.LOOSE + card.format("") + "*KINEMATIC\n1\n3, 3\n")
        self.assertEqual(Imported(text).options["constraint"]["reference_20"], {"clamped": "y"})
        text = cube(self.LOOSE + card.format("") + "*DISTRIBUTING\n1, 3\n")
        rows = refused(text, dialect="calculix")
        self.assertIn("*DISTRIBUTING: CalculiX distributes", rows[0])
        (row,) = refused(cube(self.LOOSE + card.format("")))
        self.assertIn("*COUPLING: no *KINEMATIC or *DISTRIBUTING follows", row)
        rows = refused(cube(self.LOOSE + card.format("") + "*KINEMATIC\n1, 7\n"))
        self.assertIn("*KINEMATIC: components are 1 to 6", rows[1])

    def test_a_distributing_coupling_is_a_mean(self):
        cards = "*ELEMENT, TYPE=DCOUP3D, ELSET=D\n9, 20\n"
        cards += "*DISTRIBUTING COUPLING, ELSET=D\n5, 1.\n6, 3.\n"
        text = cube(self.LOOSE + cards, "*CLOAD\n20, 3, 8.\n")
        one = Imported(text, dialect="calculix")
        found = [terms(text) for text in one.options["equation"].values()]
        self.assertEqual(
            found,
            [
                {f"reference_20:{at}": 1, f"node_5:{at}": -0.25, f"node_6:{at}": -0.75}
                for at in "xyz"
            ],
        )
        self.assertEqual(one.options["load"]["reference_20"]["force"], "0.0,0.0,8.0")

    def test_springs_dashpots_and_masses(self):
        cards = "*ELEMENT, TYPE=SPRINGA, ELSET=S\n30, 5, 20\n*SPRING, ELSET=S\n\n10.\n"
        cards += "*ELEMENT, TYPE=DASHPOTA, ELSET=D\n31, 5, 6\n*DASHPOT, ELSET=D\n\n1.e-5\n"
        cards += "*ELEMENT, TYPE=SPRING1, ELSET=G\n32, 7\n*SPRING, ELSET=G\n2\n50.\n"
        cards += "*ELEMENT, TYPE=MASS, ELSET=M\n33, 20\n*MASS, ELSET=M\n0.5\n"
        options = Imported(cube(self.LOOSE + cards, "*BOUNDARY\n20, 1, 3\n")).options
        spring = {"from": "node_5", "to": "reference_20", "stiffness": 10.0}
        self.assertEqual(options["spring"]["element_30"], spring)
        dashpot = {"from": "node_5", "to": "node_6", "damping": 1e-5}
        self.assertEqual(options["spring"]["element_31"], dashpot)
        ground = {"from": "node_7", "stiffness": "0.0,50.0,0.0"}
        self.assertEqual(options["bushing"]["element_32"], ground)
        self.assertEqual(options["mass"]["reference_20"]["total"], 0.5)

    def test_joints_that_would_replace_each_other(self):
        cards = "*ELEMENT, TYPE=SPRINGA, ELSET=S\n30, 5, 6\n*SPRING, ELSET=S\n\n10.\n"
        (row,) = refused(cube(cards + "*SPRING, ELSET=S\n\n20.\n"))
        self.assertIn("-spring_element_30_stiffness would have the values 10.0 and 20.0", row)
        masses = "*ELEMENT, TYPE=MASS, ELSET=M\n33, 7\n34, 7\n*MASS, ELSET=M\n0.5\n"
        options = Imported(cube(masses)).options
        self.assertEqual(options["mass"], {"node_7": {"total": 1.0}})

    def test_elements_without_properties_and_loads_without_elements(self):
        spring = "*ELEMENT, TYPE=SPRINGA, ELSET=S\n30, 5, 6\n31, 6, 7\n"
        (row,) = refused(cube(spring + "*ELSET, ELSET=ONE\n30\n*SPRING, ELSET=ONE\n\n10.\n"))
        self.assertIn("*ELEMENT, SPRINGA: element 31 of type SPRINGA has no stiffness", row)
        (row,) = refused(cube(self.LOOSE + "*ELEMENT, TYPE=DCOUP3D, ELSET=D\n9, 20\n"))
        self.assertIn("*ELEMENT, DCOUP3D: no *DISTRIBUTING COUPLING has this element", row)
        (row,) = refused(cube("", "*DLOAD\n99, GRAV, 1., 0., 0., 1.\n"))
        self.assertIn("*DLOAD, GRAV: there is no element 99", row)
        masses = "*ELEMENT, TYPE=MASS, ELSET=M\n33, 7\n*MASS, ELSET=M\n0.5\n"
        (row,) = refused(cube(masses, "*DLOAD\nM, GRAV, 1., 0., 0., 1.\n"))
        self.assertIn("*DLOAD, GRAV: body loads on point masses are not supported", row)

    def test_ties_of_faces(self):
        ties = "*SURFACE, NAME=UP\nCUBE, S2\n*SURFACE, NAME=DOWN\nCUBE, S1\n"
        ties += "*TIE, NAME=A B, POSITION TOLERANCE=0.2, ADJUST=NO\nUP, DOWN\n"
        ties += "*TIE, NAME=A B\nDOWN, UP\n"
        options = Imported(cube(ties)).options
        first = {"slave": "UP", "master": "DOWN", "tolerance": 0.2, "adjust": False}
        self.assertEqual(options["tie"], {"A_B": first, "A_B_2": {"slave": "DOWN", "master": "UP"}})

    def test_nodes_tied_to_faces(self):
        """A node 0.005 above the top at (0.25, 0.5) follows it with the weights of the bilinear
        functions, 0.75 · 0.5 and so on, and is moved onto it; one at 0.2 stays free. The tolerance
        of CalculiX is here 0.0071."""
        brick = "*NODE\n41, 0.25, 0.5, 1.005\n42, 0.75, 0.5, 1.2\n"
        brick += "43, .75, 1.5, 1.2\n44, .25, 1.5, 1.2\n"
        brick += "*ELEMENT, TYPE=C3D4, ELSET=CUBE\n2, 41, 42, 43, 44\n"
        tie = "*SURFACE, NAME=UP\nCUBE1, S2\n*ELSET, ELSET=CUBE1\n1\n*NSET, NSET=N\n41, 42\n"
        tie += "*SURFACE, NAME=NODES, TYPE=NODE\nN\n*TIE, NAME=T{}\nNODES, UP\n"
        one = Imported(cube(brick + tie.format(""), ""))
        found = [terms(text) for text in one.options["equation"].values()]
        weights = {5: 0.375, 6: 0.125, 7: 0.125, 8: 0.375}
        for axis, equation in zip("xyz", found):
            self.assertEqual(equation.pop(f"node_41:{axis}"), 1)
            self.assertEqual(set(equation), {f"node_{at}:{axis}" for at in weights})
            for at, weight in weights.items():
                self.assertAlmostEqual(equation[f"node_{at}:{axis}"], -weight, delta=1e-13)
        self.assertEqual(len(found), 3)
        place = one.coordinates[list(one.nodes).index(41)]
        self.assertLess(np.max(np.abs(place - [0.25, 0.5, 1.0])), 1e-14)
        self.assertIn("| T | nodes | 1 | 1 |", one.account)
        one = Imported(cube(brick + tie.format(", ADJUST=NO, POSITION TOLERANCE=0.3"), ""))
        self.assertEqual(len(one.options["equation"]), 6)
        self.assertEqual(one.coordinates[list(one.nodes).index(41)].tolist(), [0.25, 0.5, 1.005])


if __name__ == "__main__":
    unittest.main()
