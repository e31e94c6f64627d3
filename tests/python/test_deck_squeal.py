#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Decks of a squeal analysis: which body moves and how, what is swept, and the band."""
import re
import sys
import unittest
from pathlib import Path

import numpy as np

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/deck")]
sys.dont_write_bytecode = True
from pin_on_plate import deck, motion, turn
from small_decks import Imported, numbers, refused

STATIC = "*STEP, UNSYMM=YES\n*STATIC\n{}*END STEP\n"
MODES = "*STEP\n*FREQUENCY\n12\n*END STEP\n"
COMPLEX = "*STEP, UNSYMM=YES\n*COMPLEX FREQUENCY{}\n{}\n*END STEP\n"
PRESS = "*DSLOAD\nBACK, P, 2.\n"
RAMP = "*CHANGE FRICTION, INTERACTION=RUB\n*FRICTION\n0.5,\n"


def abaqus(friction="*FRICTION\n0.3,\n", steps=None, move=None, **words):
    """A deck of Abaqus: pressure and motion, free modes, complex modes."""
    move = motion() if move is None else move
    steps = (
        STATIC.format(PRESS + move) + MODES + COMPLEX.format("", "10") if steps is None else steps
    )
    return Imported(deck(friction, steps), dialect="abaqus", **words)


class Motion(unittest.TestCase):
    def test_a_turn_about_an_axis(self):
        one = abaqus(move=motion("PLATE", 4.0, (1, 2, 3), (1, 2, 8)))
        self.assertEqual(list(one.options["motion"]), ["PLATE"])
        moved = one.options["motion"]["PLATE"]
        self.assertEqual(float(moved["speed"]), 4.0)
        self.assertEqual(numbers(moved["axis"]), [0, 0, 1])
        self.assertEqual(numbers(moved["origin"]), [1, 2, 3])
        (contact,) = one.options["contact"].values()
        self.assertEqual(
            (contact["pad"], contact["disc"], contact["role"], contact["slave"]),
            ("PIN_FACE", "PLATE_FACE", "sliding", "pad"),
        )

    def test_the_moving_side_is_the_disc_in_any_order(self):
        text = deck("*FRICTION\n0.3,\n", STATIC.format(motion("PLATE")), swapped=True)
        (contact,) = Imported(text, dialect="abaqus").options["contact"].values()
        self.assertEqual(
            (contact["pad"], contact["disc"], contact["slave"]), ("PIN_FACE", "PLATE_FACE", "disc")
        )

    def test_a_shift(self):
        one = abaqus(move="*MOTION, TRANSLATION, TYPE=VELOCITY\nPLATE, 1, 1, 3.\nPLATE, 2, , 4.\n")
        self.assertEqual(numbers(one.options["motion"]["PLATE"]["velocity"]), [3, 4, 0])

    def test_nodes_of_the_contact_surface_move_their_body(self):
        one = abaqus(move=motion("RUBBED"))
        self.assertEqual(list(one.options["motion"]), ["PLATE"])
        self.assertIn("among them a contact surface; the whole body moves", one.account)

    def test_motions_that_are_refused(self):
        for text, reason in (
            (motion("EDGE"), "neither all nodes of a body nor those of a contact surface"),
            (motion("PLATE", a=(1, 1, 1), b=(1, 1, 1)), "the two points of the axis coincide"),
            ("*MOTION, ROTATION, TYPE=DISPLACEMENT\nPLATE,1.,0.,0.,0.,0.,0.,1.\n", "TYPE=VELOCITY"),
            ("*MOTION, ROTATION\nPLATE, 1., 0., 0.\n", "a line of ROTATION has 8 fields"),
            (motion("PIN") + motion("PLATE", 2.0), "both sides of a contact move"),
            (motion("NOWHERE"), "there is no node set 'NOWHERE'"),
        ):
            lines = refused(deck("*FRICTION\n0.3,\n", STATIC.format(text)), dialect="abaqus")
            self.assertTrue(any(reason in line for line in lines), (reason, lines))

    def test_a_prescribed_turn_stands_for_a_motion(self):
        """The displacements of a turn by 0.02 about an axis along z through (5, 1)."""
        one = Imported(turn(0.02, (5.0, 1.0)), dialect="calculix")
        moved = one.options["motion"]["PLATE"]
        self.assertEqual(float(moved["speed"]), 1.0)
        np.testing.assert_allclose(numbers(moved["axis"]), [0, 0, 1], atol=1e-9)
        np.testing.assert_allclose(numbers(moved["origin"])[:2], [5, 1], rtol=1e-9)
        # The steady state has the hub where it is: only zeros are left of its supports.
        self.assertNotIn("displacement", str(one.options["constraint"]))
        self.assertEqual(one.options["flutter"]["friction_damping"], False)
        self.assertIn("only its direction counts", one.account)

    def test_a_turn_beside_a_face_that_does_not_exist(self):
        text = turn(0.02, (5.0, 1.0)).replace("PLATE, S2", "1, S2\n99999, S1", 1)
        (row,) = refused(text, dialect="calculix")
        self.assertIn("*CONTACT PAIR: element 99999 is not a solid element", row)

    def test_the_sense_of_a_turn(self):
        moved = Imported(turn(-0.02, (5.0, 1.0)), dialect="calculix").options["motion"]["PLATE"]
        np.testing.assert_allclose(numbers(moved["axis"]), [0, 0, -1], atol=1e-9)

    def test_a_large_turn(self):
        """By 1.2 rad: its displacements are far from those of a small turn."""
        one = Imported(turn(-1.2, (5.0, 1.0), finite=True), dialect="calculix")
        moved = one.options["motion"]["PLATE"]
        np.testing.assert_allclose(numbers(moved["axis"]), [0, 0, -1], atol=1e-9)
        np.testing.assert_allclose(numbers(moved["origin"])[:2], [5, 1], rtol=1e-9)

    def test_friction_that_the_step_of_the_modes_changes(self):
        text = turn(0.02, (5.0, 1.0)).replace(
            "*FREQUENCY\n12\n",
            "*FREQUENCY\n12\n*CHANGE FRICTION, INTERACTION=RUB\n*FRICTION\n0.2, 5000.\n",
        )
        found = Imported(text, dialect="calculix").options["flutter"]["friction"]
        self.assertEqual([float(word) for word in found.split(":")], [0.2, 0.3, 0.01])

    def test_a_push_is_no_motion(self):
        """The back of the pin is pressed by a prescribed displacement, across the contact."""
        text = turn(0.02, (5.0, 1.0)).replace(
            "*END STEP\n", "PIN_BACK, 3, 3, -0.01\n*END STEP\n", 1
        )
        one = Imported(text, dialect="calculix")
        self.assertEqual(list(one.options["motion"]), ["PLATE"])
        held = one.options["constraint"]["PIN_BACK"]
        self.assertEqual(numbers(held["displacement"]), [0, 0, -0.01])

    def test_an_uneven_push_beside_a_turn(self):
        """A corner of the back of the pin is pressed further: no rigid motion, and none needed."""
        text = turn(0.02, (5.0, 1.0)).replace(
            "*END STEP\n", "PIN_BACK, 3, 3, -0.01\n1003, 3, 3, -0.02\n*END STEP\n", 1
        )
        one = Imported(text, dialect="calculix")
        self.assertEqual(list(one.options["motion"]), ["PLATE"])

    def test_displacements_that_are_no_turn(self):
        text = turn(0.02, (5.0, 1.0)).replace("*END STEP\n", "1, 1, 1, 0.5\n*END STEP\n", 1)
        self.assertIn(
            "are not those of a rigid turn or shift", " ".join(refused(text, dialect="calculix"))
        )

    def test_a_speed_that_the_deck_does_not_have(self):
        """An exponential law needs the slip rate, so --speed is asked for."""
        text = turn(0.02, (5.0, 1.0), "*FRICTION, EXPONENTIAL DECAY\n0.5, 0.3, 2.\n")
        text += COMPLEX.format("", "10")
        self.assertIn("give it with --speed", " ".join(refused(text)))
        one = Imported(text, speed=7.0)
        self.assertEqual(float(one.options["motion"]["PLATE"]["speed"]), 7.0)

    def test_a_speed_that_nothing_needs(self):
        lines = refused(
            deck("*FRICTION\n0.3,\n", STATIC.format(motion())), dialect="abaqus", speed=2
        )
        self.assertIn("--speed", " ".join(lines))


class Sweep(unittest.TestCase):
    def flutter(self, *given, **words):
        return abaqus(*given, **words).options["flutter"]

    def test_a_constant_coefficient(self):
        found = self.flutter()
        self.assertEqual(found["friction"], 0.3)
        self.assertEqual(found["friction_damping"], False)

    def test_friction_damping(self):
        steps = STATIC.format(PRESS + motion()) + COMPLEX.format(", FRICTION DAMPING=YES", "10")
        self.assertEqual(self.flutter(steps=steps)["friction_damping"], True)

    def test_a_ramp_is_swept(self):
        """From 0.1 to 0.5 in ten steps."""
        steps = STATIC.format(PRESS + motion()) + STATIC.format(RAMP) + COMPLEX.format("", "10")
        found = self.flutter("*FRICTION\n0.1,\n", steps)
        first, last, step = (float(word) for word in found["friction"].split(":"))
        self.assertEqual((first, last), (0.1, 0.5))
        self.assertAlmostEqual(step, 0.04, delta=1e-12)

    def test_several_points(self):
        """Complex modes at 0.3 and, after a change, at 0.5: two points."""
        steps = STATIC.format(PRESS + motion()) + MODES + COMPLEX.format("", "10")
        steps += STATIC.format(RAMP) + MODES + COMPLEX.format("", "10")
        self.assertEqual(numbers(self.flutter(steps=steps)["friction"]), [0.3, 0.5])

    def test_loads_after_free_modes_are_refused(self):
        steps = STATIC.format(PRESS + motion()) + MODES + STATIC.format(PRESS)
        lines = refused(deck("*FRICTION\n0.3,\n", steps), dialect="abaqus")
        self.assertIn("unless it only changes friction", " ".join(lines))

    def test_an_exponential_law(self):
        """μ = μk + (μs − μk) e^(−d w): ratio μs/μk at rest, decay speed 1/d."""
        one = abaqus("*FRICTION, EXPONENTIAL DECAY\n0.6, 0.3, 2.\n")
        law = one.options["friction"]
        self.assertEqual(law["law"], "exponential")
        self.assertEqual((float(law["static_ratio"]), float(law["decay_speed"])), (2.0, 0.5))
        self.assertEqual(one.options["flutter"]["friction"], 0.3)

    def test_a_table_over_the_slip_rate(self):
        one = abaqus("*FRICTION\n0.4, 0.\n0.3, 1.\n0.2, 5.\n")
        law = one.options["friction"]
        self.assertEqual(law["law"], "table")
        self.assertEqual(numbers(law["table_speed"]), [0, 1, 5])
        np.testing.assert_allclose(numbers(law["table_factor"]), [1, 0.75, 0.5], rtol=1e-15)
        self.assertEqual(one.options["flutter"]["friction"], 0.4)

    def test_the_second_number_of_calculix_is_no_slip_rate(self):
        """0.3, 5000.: a stick slope, which exact friction does not have."""
        text = turn(0.02, (5.0, 1.0), "*FRICTION\n0.3, 5000.\n")
        one = Imported(text, dialect="calculix")
        self.assertNotIn("friction", one.options)
        self.assertEqual(one.options["flutter"]["friction"], 0.3)
        self.assertIn("the stick slope is not used", one.account)
        self.assertIn("choose --dialect", " ".join(refused(text)))

    def test_laws_that_are_refused(self):
        for law, reason in (
            ("*FRICTION\n0.3, 0., 10.\n", "depends on pressure or temperature"),
            ("*FRICTION\n0.3, 1.\n0.2, 1.\n", "slip rates of a table of friction have to ascend"),
            ("*FRICTION\n-0.3,\n", "are not negative"),
            ("*FRICTION, ROUGH\n", "ROUGH friction"),
            ("*FRICTION, TAUMAX=3.\n0.3,\n", "TAUMAX"),
            ("*FRICTION\n", "the coefficient of friction is missing"),
        ):
            lines = refused(deck(law, STATIC.format(PRESS + motion())), dialect="abaqus")
            self.assertTrue(any(reason in line for line in lines), (reason, lines))


class Roles(unittest.TestCase):
    def test_friction_without_motion_sticks_up_to_its_limit(self):
        one = Imported(deck("*FRICTION\n0.3,\n", STATIC.format(PRESS)), dialect="abaqus")
        (contact,) = one.options["contact"].values()
        self.assertEqual((contact["role"], contact["friction"]), ("sticking", 0.3))
        self.assertEqual(contact["release"], True)
        self.assertEqual(one.options["flutter"]["friction"], 0.0)

    def test_rough_contact_sticks(self):
        one = Imported(deck("*FRICTION, ROUGH\n", STATIC.format(PRESS)), dialect="abaqus")
        (contact,) = one.options["contact"].values()
        self.assertEqual((contact["role"], "friction" in contact), ("sticking", False))

    def test_a_contact_without_friction_does_not_count(self):
        """It may slide; complex modes of the deck then have nothing to be unstable about."""
        steps = STATIC.format(PRESS + motion())
        (contact,) = abaqus("", steps).options["contact"].values()
        self.assertEqual(contact["role"], "frictionless")
        lines = refused(deck("", steps + COMPLEX.format("", "10")), dialect="abaqus")
        self.assertIn("complex modes need a contact with friction", " ".join(lines))

    def test_no_separation(self):
        text = "*SURFACE BEHAVIOR, NO SEPARATION\n*FRICTION\n0.3,\n"
        (contact,) = abaqus(text).options["contact"].values()
        self.assertEqual(contact["separation"], False)

    def test_methods_of_contact(self):
        """They are those of the other program; without SMALL SLIDING sliding is small as well."""
        for method in ("DIRECT", "PENALTY", "AUGMENTED LAGRANGE"):
            one = abaqus(f"*SURFACE BEHAVIOR, {method}\n*FRICTION\n0.3,\n")
            (contact,) = one.options["contact"].values()
            self.assertNotIn("stiffness", contact)
            self.assertTrue(any("sliding is small" in choice for choice in one.journal.choices))

    def test_a_pair_that_is_given_twice(self):
        text = deck("*FRICTION\n0.3,\n", STATIC.format(PRESS + motion()))
        line = text[text.index("*CONTACT PAIR") :].split("\n")[1]
        rows = refused(text.replace(line, f"{line}\n{line}"), dialect="abaqus")
        self.assertTrue(any("is given twice" in row for row in rows))

    def test_adjusted_nodes_start_in_contact(self):
        """The pin is 0.01 above the plate."""
        steps = STATIC.format(PRESS + motion())
        for adjust, gap in ((0.02, 0.0), (0.005, "measured")):
            text = deck("*FRICTION\n0.3,\n", steps, gap=0.01, pair=f", ADJUST={adjust}")
            (contact,) = Imported(text, dialect="abaqus").options["contact"].values()
            self.assertEqual(contact["gap"], gap)


class Band(unittest.TestCase):
    def test_modes_are_counted_twice(self):
        """The band ends at about half of the free modes, so that of 12 modes asks for 24."""
        one = abaqus()
        self.assertEqual(one.options["modes"]["count"], 24)
        self.assertNotIn("band", one.options["flutter"])

    def test_an_upper_limit(self):
        steps = STATIC.format(PRESS + motion()) + COMPLEX.format("", ", , 900.")
        self.assertEqual(float(abaqus(steps=steps).options["flutter"]["band"]), 900)

    def test_large_displacements(self):
        """Small ones if NLGEOM is ignored; free vibrations then have the stress, as in Abaqus."""
        steps = "*STEP, NLGEOM=YES\n*STATIC\n" + PRESS + motion() + "*END STEP\n" + MODES
        lines = refused(deck("*FRICTION\n0.3,\n", steps), dialect="abaqus")
        self.assertTrue(re.search("NLGEOM: large displacements", " ".join(lines)))
        one = abaqus(steps=steps, ignored=["NLGEOM"])
        self.assertEqual(one.options["elasticity"]["prestress"], True)


if __name__ == "__main__":
    unittest.main()
