#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Values of decks that are computed: parameters, amplitudes, and tables over temperatures."""
import math
import sys
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/deck")]
sys.dont_write_bytecode = True
from small_decks import CUBE, HELD, STATIC, STEEL, Imported, cube, numbers, refused

from squeal.deck.inp.expression import evaluate
from squeal.deck.journal import Fault


class Parameters(unittest.TestCase):
    def test_expressions(self):
        names = {"width": 2.5, "n": 3}
        for text, wanted in (
            ("2.1e5", 2.1e5),
            ("width*2 + n", 8.0),
            ("-2**2", -4),
            ("2**-1", 0.5),
            ("2**3**2", 512),
            ("-(1 - 4)*2/3.", 2.0),
            ("7 - 2 - 1", 4),
            ("12/4/3", 1),
            ("3.0*sin(45*pi/180.0)", 3 * math.sqrt(0.5)),
            ("sqrt(abs(-16)) + exp(log(2)) + log10(100)", 8.0),
            (".5", 0.5),
        ):
            self.assertAlmostEqual(evaluate(text, names), wanted, places=13, msg=text)
        self.assertIsInstance(evaluate("n + 1", names), int)

    def test_nothing_but_arithmetic(self):
        for text in (
            *("", "1 +", "(1", "1)", "2 3", "'steel'", "open('x')", "__import__", "n.real", "a[0]"),
            *("1/0", "5/2", "(-8)**.5", "10**400", "exp(1000)", "log(0)", "sin", "sin()", "1;2"),
            *("(" * 5000, "9" * 5000, "9**9**9**9", "-" * 1000 + "1", "lambda: 1", "n if n else 1"),
        ):
            with self.assertRaises(Fault, msg=text):
                evaluate(text, {"n": 3})

    def test_values_replace_names(self):
        card = "*PARAMETER\n# steel\nE = 2.1e5; rho=7.8*10.**-9\nforce=E/1e5\nlast = 4*2\n"
        text = CUBE.replace("7, 8\n", "7, <last>\n")
        text += STEEL.replace("210000.", "<E>").replace("7.8E-9", "< rho >") + HELD
        one = Imported(card + text + STATIC.format("*CLOAD\nTOP, 3, <FORCE>\n"))
        self.assertEqual(one.options["material"]["CUBE"]["young"], 2.1e5)
        self.assertAlmostEqual(one.options["material"]["CUBE"]["density"], 7.8e-9, delta=1e-20)
        self.assertEqual(numbers(one.options["load"]["TOP"]["force"]), [0, 0, 8.4])
        self.assertIn("last is 8", one.remarks("PARAMETER")[1])

    def test_faults_are_named(self):
        for card, reason in (
            ("*PARAMETER\nx = y\n", "deck.inp:2: *PARAMETER: 'y': 'y' is not a function"),
            ("*PARAMETER\nx = 1\nX = 2\n", "the parameter x is defined twice"),
            ("*PARAMETER\nx + 1\n", "is not an assignment"),
            ("*PARAMETER, TABLE=T\nx = 1\n", "*PARAMETER, TABLE: this parameter"),
        ):
            rows = refused(card + cube())
            self.assertEqual(len(rows), 1)
            self.assertIn(reason, rows[0])
        text = cube(step="*CLOAD\nTOP, 3, <x>\n")
        self.assertIn("'<x>' is not a number", refused("*PARAMETER\ny = 1\n" + text)[0])
        rows = refused("*PARAMETER\nx = ?\n" + text, ignored=["PARAMETER"])
        self.assertIn("'<x>' is not a number", rows[0])


class Amplitudes(unittest.TestCase):
    LOAD = "*CLOAD, AMPLITUDE=A\nTOP, 3, 2.\n"

    def force(self, table, more="", model="", step=LOAD):
        one = Imported(cube(f"*AMPLITUDE, NAME=A{more}\n{table}\n" + model, step))
        return numbers(one.options["load"]["TOP"]["force"])[2] / 8, one

    def test_the_value_at_the_end_of_the_step_counts(self):
        for table, factor in (("0., 0., 1., 1.", 1), ("0., 0., 4., 2.", 0.5), ("0., .3", 0.3)):
            found, one = self.force(table)
            self.assertAlmostEqual(found, factor, places=15)
            named = f"multiplied by {factor:g}, the value of A at the end of the step"
            self.assertTrue(any(named in choice for choice in one.journal.choices))
            self.assertEqual(one.remarks("AMPLITUDE")[0], "translated")
        one = Imported(cube("*AMPLITUDE, NAME=A\n0., 1.\n"))
        self.assertEqual(one.remarks("AMPLITUDE"), ("not used", "no load refers to this amplitude"))

    def test_pressures_body_loads_and_displacements(self):
        step = "*DLOAD, AMPLITUDE=A\n1, P2, 3.\nCUBE, GRAV, 8., 0., 0., -1.\n"
        step += "*BOUNDARY, AMPLITUDE=A\n5, 1, 1, 0.2\n"
        options = Imported(cube("*AMPLITUDE, NAME=A\n0., 0., 2., 1.\n", step)).options
        self.assertEqual(options["load"]["pressed"]["pressure"], 1.5)
        self.assertEqual(numbers(options["load"]["CUBE"]["acceleration"]), [0, 0, -4])
        self.assertEqual(numbers(options["constraint"]["node_5"]["displacement"]), [0.1, 0, 0])

    def test_what_is_refused(self):
        for table, more, reason in (
            ("0., 0., .5, 1., 1., .5", "", "falls within the step"),
            ("0., -1., 1., 1.", "", "falls within the step"),
            ("0., 0., 3., 1.", ", TIME=TOTAL TIME", "goes on after the step"),
            ("0., 0., 1., 1.", ", DEFINITION=SMOOTH STEP", "DEFINITION=SMOOTH STEP"),
            ("0., 0., 1., 1.", ", SMOOTH=0.1", "the parameter SMOOTH"),
            ("0., 0., 0., 1.", "", "must increase"),
            ("0., 0., 1.", "", "pairs of time and value"),
        ):
            (row,) = refused(cube(f"*AMPLITUDE, NAME=A{more}\n{table}\n", self.LOAD))
            self.assertIn("*CLOAD, AMPLITUDE: ", row)
            self.assertIn(reason, row)
        self.assertIn("there is no amplitude 'A'", refused(cube(step=self.LOAD))[0])
        table = "*AMPLITUDE, NAME=A\n0., 0., .5, 1., 1., .5\n"
        one = Imported(cube(table, self.LOAD), ignored=["AMPLITUDE"])
        self.assertEqual(numbers(one.options["load"]["TOP"]["force"]), [0, 0, 8])


class Temperatures(unittest.TestCase):
    def test_constants_at_the_temperature_of_the_start(self):
        table = "200000., 0.3, 20.\n100000., 0.4, 120."
        text = cube().replace("210000., 0.3", table).replace("7.8E-9", "8.E-9, 20.\n4.E-9, 120.")
        start = "*INITIAL CONDITIONS, TYPE=TEMPERATURE\n{}, 45.\n"
        for more, wanted in (
            ("", (200000, 0.3, 8e-9)),
            (start.format("ALL"), (175000, 0.325, 7e-9)),
        ):
            one = Imported(text + more).options["material"]["CUBE"]
            for key, value in zip(("young", "poisson", "density"), wanted):
                self.assertAlmostEqual(one[key] / value, 1, places=14)
        for row in refused(text + start.format("TOP")):
            self.assertIn("temperatures, which differ at the start", row)
        (row,) = refused(text.replace("0.4, 120.", "0.4, 20."))
        self.assertIn("have to ascend", row)


if __name__ == "__main__":
    unittest.main()
