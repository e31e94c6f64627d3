#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Cases of Nastran decks: coordinate systems, materials, supports and loads."""
import sys
import unittest
from pathlib import Path

import numpy as np

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/deck")]
sys.dont_write_bytecode = True
from bdf_cards import COMPLEX, EIGRL, ORIGIN, TURN, card, frame_of, numbers, turned
from small_bdf import CONTROL, CUBE, POINTS, STEEL, cube, force, imported, refusals


class Systems(unittest.TestCase):
    def place(self, cards, coordinates, system=3):
        """Returns the place of grid 5 with coordinates in a system."""
        text = cube(force() + cards)
        words = ",".join(f"{value!r}" for value in coordinates)
        return imported(text.replace("GRID,5,,0.,0.,1.", f"GRID,5,{system},{words}")).coordinates[4]

    def near(self, found, wanted):
        np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-12)

    def test_places_in_each_kind(self):
        r, theta, phi = 1.3, 25.0, 70.0
        t, p = np.radians([theta, phi])
        for name, coordinates, local in (
            ("CORD2R", (0.1, 0.2, 1.1), (0.1, 0.2, 1.1)),
            ("CORD2C", (r, theta, 0.4), (r * np.cos(t), r * np.sin(t), 0.4)),
            (
                "CORD2S",
                (r, theta, phi),
                (
                    r * np.sin(t) * np.cos(p),
                    r * np.sin(t) * np.sin(p),
                    r * np.cos(t),
                ),
            ),
        ):
            axes = TURN.T
            found = self.place(card(name, 3, 0, ORIGIN, axes), coordinates)
            self.near(found, ORIGIN + np.array(local) @ axes)

    def test_chains_in_any_order(self):
        """A cylindrical system in a spherical one in a turned rectangular one."""
        outer = card("CORD2R", 7, 0, ORIGIN, TURN.T)
        # Three points of the middle system, spherical coordinates of system 8.
        r = np.sqrt(2.0)
        middle = card("CORD2S", 8, 7, np.array([0.5, 0.0, 0.0]), np.eye(3))
        points = [(1.0, 90.0, 90.0), (r, 45.0, 90.0), (r, 90.0, 45.0)]
        words = [f"{value!r}" for point in points for value in point]
        inner = f"CORD2C,3,8,{','.join(words[:6])}\n,{','.join(words[6:])}\n"
        # In system 8: origin (0, 1, 0), z through (0, 1, 1), x towards (1, 1, 0).
        t = np.radians(30)
        local = np.array([0.5, 0, 0]) + [2 * np.cos(t), 1 + 2 * np.sin(t), 0.25]
        wanted = ORIGIN + local @ TURN.T
        for cards in (outer + middle + inner, inner + middle + outer):
            self.near(self.place(cards, (2.0, 30.0, 0.25)), wanted)

    def test_systems_of_grids(self):
        """CORD1 by grids, one of which has a place in another system; two systems on a card."""
        outer = card("CORD2R", 7, 0, ORIGIN, TURN.T)
        grids = "GRID,101,7,0.,0.,0.\nGRID,102,7,0.,0.,4.\nGRID,103,7,2.,0.,1.\n"
        for name in ("CORD1R", "CORD1C"):
            cards = outer + grids + f"{name},9,2,3,4,3,101,102,103\n"
            local = (1.0, 0.5, 0.2)
            if name == "CORD1C":
                local = (1.0 * np.cos(np.radians(0.5)), np.sin(np.radians(0.5)), 0.2)
            self.near(self.place(cards, (1.0, 0.5, 0.2)), ORIGIN + np.array(local) @ TURN.T)

    def test_defaults_of_grids(self):
        outer = card("CORD2R", 7, 0, ORIGIN, TURN.T) + "GRDSET,,7,,,,7,2\n"
        text = cube(force() + outer + "GRID,9,0,9.,9.,9.,0,0\nCONM2,1,9,,1.\n")
        text = text.replace("GRID,1,,", "GRID,1,0,")
        one = imported(text)
        self.near(one.coordinates[0], POINTS[0])
        self.near(one.coordinates[6], ORIGIN + TURN @ POINTS[6])
        self.assertEqual(
            numbers(one.options["reference"]["reference_9"]["position"]).tolist(), [9] * 3
        )
        held = one.options["constraint"]["ps_2"]
        self.assertEqual((held["clamped"], held["frame"]), ("y", "cord_7"))
        self.assertEqual(one.groups["ps_2"], [5, 6, 7, 8])

    def test_systems_that_are_wrong(self):
        for cards, reason in (
            ("CORD2R,3,3,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n", "coordinate system 3 depends on itself"),
            ("CORD2R,3,4,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n", "there is no coordinate system 4"),
            ("CORD2R,3,,0.,0.,0.,0.,0.,1.\n,0.,0.,2.\n", "lie on a line"),
            ("CORD1R,3,1,5,2\n", "depends on itself"),
            ("CORD1R,3,1,99,2\n", "grid 99 does not exist"),
        ):
            text = cube(force() + cards).replace("GRID,5,,", "GRID,5,3,")
            rows = refusals(text)
            self.assertIn("deck.bdf:10: GRID: grid 5: ", rows[0])
            self.assertIn(reason, rows[0])

    def test_components_of_supports_and_forces(self):
        """Supports have the axes of CD; forces those of their own system."""
        outer = card("CORD2C", 7, 0, ORIGIN, TURN.T)
        text = cube("FORCE,20,7,7,2.,0.,3.,0.\nSPC1,10,2,7\n" + outer)
        text = text.replace("GRID,7,,1.,1.,1.", "GRID,7,,1.,1.,1.,7")
        one = imported(text)
        self.assertIn({"clamped": "y", "frame": "cord_7"}, one.options["constraint"].values())
        self.near(numbers(one.options["frame"]["cord_7"]["origin"]), ORIGIN)
        self.near(numbers(one.options["frame"]["cord_7"]["axis"]), TURN.T[2])
        arm = TURN.T @ ([1, 1, 1] - ORIGIN)
        tangent = np.array([-arm[1], arm[0], 0]) / np.hypot(arm[0], arm[1]) @ TURN.T
        (load,) = one.options["load"].values()
        self.near(numbers(load["force"]), 6 * tangent)

    def test_grids_on_the_axis_of_a_cylinder(self):
        """Their components have the axes that define the system."""
        outer = card("CORD2C", 7, 0, np.array([1.0, 1.0, -3.0]), turned((0, 0, 1), 30).T)
        text = cube(force() + "SPC1,10,1,7\n" + outer).replace("1.,1.,1.", "1.,1.,1.,7")
        one = imported(text)
        self.assertIn({"clamped": "x", "frame": "cord_7_axis"}, one.options["constraint"].values())
        self.near(frame_of(one.options, "cord_7_axis"), turned((0, 0, 1), 30).T)

    def test_axes_of_spherical_systems(self):
        outer = card("CORD2S", 7, 0, ORIGIN, np.eye(3))
        text = cube(force() + "SPC1,10,3,7\n" + outer).replace("1.,1.,1.", "1.,1.,1.,7")
        one = imported(text)
        (name,) = one.options["frame"]
        x, y, z = np.array([1, 1, 1]) - ORIGIN
        rho, across = np.sqrt(x * x + y * y + z * z), np.hypot(x, y)
        wanted = [
            [x / rho, y / rho, z / rho],
            [z * x / across / rho, z * y / across / rho, -across / rho],
            [-y / across, x / across, 0],
        ]
        self.near(frame_of(one.options, name), np.array(wanted))


class Materials(unittest.TestCase):
    def constants(self, card, cards="", control=CONTROL):
        text = control + CUBE + STEEL.replace("MAT1,1,210000.,,0.3,7.8-9\n", card)
        one = imported(text + "SPC1,10,123,1,THRU,4\n" + force() + cards)
        return one.options["material"]["psolid_1"], one

    def test_two_of_the_three_constants(self):
        for words, young, poisson in (
            ("200.,,.25", 200, 0.25),
            ("200.,80.,", 200, 0.25),
            (",80.,.25", 200, 0.25),
            ("200.,80.,.25", 200, 0.25),
            ("200.,,", 200, 0),
            (",80.,", 160, 0),
        ):
            found, _ = self.constants(f"MAT1,1,{words},3.\n")
            self.assertAlmostEqual(found["young"], young, 10)
            self.assertAlmostEqual(found["poisson"], poisson, 12)
        (row,) = refusals(cube(force()).replace("210000.,,", "210000.,99.,"))
        self.assertIn("MAT1, G: it differs from E / (2 + 2 NU) = 80769.2", row)

    def test_fields_without_effect_are_named(self):
        _, one = self.constants("MAT1,1,200.,,.25,3.\n,100.,100.,50.\n")
        self.assertIn("not used: field 2 of line 2, 3 of line 2", one.remarks("MAT1")[1])

    def test_masses_have_the_factor_of_weights(self):
        found, one = self.constants(
            "MAT1,1,200.,,.25,3.\n", "PARAM,WTMASS,.5\nGRID,9,,0.,0.,4.\nCONM2,1,9,,4.\n"
        )
        self.assertEqual(found["density"], 1.5)
        self.assertEqual(one.options["mass"]["reference_9"]["total"], 2.0)

    def test_anisotropic_laws(self):
        """The strains of MAT9 are xx, yy, zz, xy, yz, zx, ours 11, 22, 33, 12, 13, 23."""
        rng = np.random.default_rng(4)
        matrix = rng.random((6, 6))
        matrix = matrix @ matrix.T + 6 * np.eye(6)
        values = [f"{matrix[i, j]:.10f}" for i in range(6) for j in range(i, 6)]

        def written(values):
            words = ["1", *values, "2.5"]
            return "MAT9," + "\n,".join(",".join(words[at : at + 8]) for at in (0, 8, 16)) + "\n"

        found, _ = self.constants(written(values))
        place = {"11": 0, "22": 1, "33": 2, "12": 3, "23": 4, "13": 5}
        order = "11 22 33 12 13 23".split()
        wanted = [matrix[place[a], place[b]] for at, a in enumerate(order) for b in order[: at + 1]]
        np.testing.assert_allclose(numbers(found["anisotropic"]), wanted, rtol=1e-9)
        self.assertEqual(found["density"], 2.5)
        sparse = [
            value if (i == j or max(i, j) < 3) else ""
            for value, (i, j) in zip(values, ((i, j) for i in range(6) for j in range(i, 6)))
        ]
        found, _ = self.constants(written(sparse))
        wanted = [
            matrix[place[a], place[b]]
            for a, b in (
                *(
                    ("11", "11"),
                    ("11", "22"),
                    ("22", "22"),
                    ("11", "33"),
                    ("22", "33"),
                    ("33", "33"),
                ),
                *(("12", "12"), ("13", "13"), ("23", "23")),
            )
        ]
        np.testing.assert_allclose(numbers(found["orthotropic"]), wanted, rtol=1e-9)

    def test_axes_of_materials(self):
        words = [
            "1",
            "6.",
            "",
            "",
            "",
            "",
            "",
            "6.",
            "",
            "",
            "",
            "",
            "6.",
            "",
            "",
            "",
            "1.",
            "",
            "",
        ]
        words += ["1.", "", "2.", "2.5"]
        law = "MAT9," + "\n,".join(",".join(words[at : at + 8]) for at in (0, 8, 16)) + "\n"
        for name, key in (("CORD2R", "orientation"), ("CORD2C", "cylindrical")):
            text = CONTROL + CUBE + law + "PSOLID,1,1,7\nSPC1,10,123,1,THRU,4\n" + force()
            found = imported(text + card(name, 7, 0, ORIGIN, TURN.T)).options["material"][
                "psolid_1"
            ]
            axes = TURN.T
            wanted = [*axes[0], *axes[1]] if key == "orientation" else [*ORIGIN, *axes[2]]
            np.testing.assert_allclose(numbers(found[key]), wanted, atol=1e-12)
        for system, reason in (("-1", "CORDM < 0"), ("99", "there is no coordinate system 99")):
            (row,) = refusals(text.replace("PSOLID,1,1,7", f"PSOLID,1,1,{system}"))
            self.assertIn(reason, row)

    def test_structural_damping(self):
        law = "MAT1,1,200.,,.25,3.,,,.04\n"
        _, one = self.constants(law)
        self.assertNotIn("loss_factor", one.text)
        self.assertIn("GE is not used", one.account)
        found, _ = self.constants(law, EIGRL + "PARAM,W4,6283.185307179586\n", COMPLEX)
        self.assertEqual(found["loss_factor"], 0.04)
        self.assertAlmostEqual(found["loss_frequency"], 1000, 9)
        text = cube(EIGRL, control=COMPLEX).replace("7.8-9", "7.8-9,,,.04")
        (row,) = refusals(text)
        self.assertIn("MAT1, GE: it needs the frequency", row)

    def test_structural_damping_of_all(self):
        """PARAM,G adds to GE; PARAM,W3 is its frequency."""
        law = "MAT1,1,200.,,.25,3.,,,.04\nPARAM,G,.01\nPARAM,W3,100.\nPARAM,W4,100.\n"
        found, _ = self.constants(law, EIGRL, COMPLEX)
        self.assertAlmostEqual(found["loss_factor"], 0.05, 14)
        self.assertAlmostEqual(found["loss_frequency"], 100 / (2 * np.pi), 12)
        rows = refusals(cube(EIGRL + "PARAM,G,.01\n", control=COMPLEX))
        self.assertIn("PARAM,G needs the frequency", rows[0])

    def test_quadratures(self):
        for words, mode in (("", None), (",,,,FULL", "none"), (",,TWO,,1", "none")):
            text = cube(force()).replace("PSOLID,1,1\n", f"PSOLID,1,1{words}\n")
            found = imported(text).options.get("elasticity", {}).get("incompatible_modes")
            self.assertEqual(found, mode)
        (row,) = refusals(cube(force()).replace("PSOLID,1,1\n", "PSOLID,1,1,,,,,PFLUID\n"))
        self.assertIn("PSOLID, FCTN: PFLUID: elements of fluids", row)
        (row,) = refusals(cube(force()).replace("PSOLID,1,1\n", "PSOLID,2,1\n"))
        self.assertIn("1 solid elements have no PSOLID, such as 1", row)


class State(unittest.TestCase):
    def test_ways_to_hold(self):
        for cards, held in (
            ("SPC1,10,123,1,2,3,4\n", {"spc_10": "xyz"}),
            ("SPC1,10,13,1,THRU,2\nSPC1,10,13,3,THRU,9\n", None),
            ("SPC,10,1,12,,2,12\nSPC,10,3,12\n", {"spc_10": "xy"}),
            ("SPC1,7,123,1\nSPC1,8,123,2\nSPCADD,10,7,8\n", None),
            ("SPC1,10,123456,1,2,3,4\n", {"spc_10": "xyz"}),
        ):
            one = imported(cube(force(), held=cards))
            if held:
                found = {
                    name: value["clamped"] for name, value in one.options["constraint"].items()
                }
                self.assertEqual(found, held)
        self.assertEqual(
            one.remarks("SPC1")[1], "rotations of nodes of solid elements do not exist"
        )

    def test_prescribed_values(self):
        one = imported(cube(force() + "SPC,10,7,3,.5\n"))
        values = [value.get("displacement") for value in one.options["constraint"].values()]
        self.assertIn("0.0,0.0,0.5", values)
        one = imported(cube("SPC1,10,3,7\nSPCD,20,7,3,.25\n"))
        values = [value.get("displacement") for value in one.options["constraint"].values()]
        self.assertIn("0.0,0.0,0.25", values)
        (row,) = refusals(cube("SPCD,20,7,3,.25\n"))
        self.assertIn("component 3 of grid 7 has no SPC", row)

    def test_combined_loads(self):
        cards = "FORCE,1,5,,1.,1.,0.,0.\nFORCE,2,5,,1.,0.,1.,0.\nLOAD,30,2.,5.,1\n"
        one = imported(cube(cards + "LOAD,20,3.,1.,30,-1.,2,2.,1\n"))
        self.assertEqual(numbers(one.options["load"]["node_5"]["force"]).tolist(), [36, -3, 0])
        self.assertNotIn("is not selected", one.account)
        # Each union of 60 levels joins two unions, which both join those of the next level.
        chain = "".join(
            f"LOAD,{one},1.,.5,{after},.5,{after + 1}\n"
            for level in range(60)
            for after in (2 * level + 22,)
            for one in (after - 2, after - 1)
        )
        one = imported(cube("FORCE,140,5,,1.,1.,0.,0.\nFORCE,141,5,,1.,0.,1.,0.\n" + chain))
        self.assertEqual(numbers(one.options["load"]["node_5"]["force"]).tolist(), [0.5, 0.5, 0])
        (row,) = refusals(cube("LOAD,20,1.,1.,30\nLOAD,30,1.,1.,20\n"))
        self.assertIn("LOAD 20 contains itself", row)

    def test_unions_that_contain_themselves(self):
        for cards, number in (
            ("SPC1,11,123,1,2\nSPCADD,10,11,12\nSPCADD,12,10\n", 10),
            ("SPC1,11,123,1,2\nSPCADD,10,11,10\n", 10),
            ("SPCADD,10,12,13\nSPCADD,12,13\nSPCADD,13,14\nSPCADD,14,12\n", 12),
        ):
            (row,) = refusals(cube(force(), held=cards))
            self.assertIn(f"SPCADD {number} contains itself", row)

    def test_forces_along_two_grids(self):
        one = imported(cube("FORCE1,20,5,10.,1,7\n"))
        wanted = 10 / np.sqrt(3) * np.ones(3)
        np.testing.assert_allclose(numbers(one.options["load"]["node_5"]["force"]), wanted)

    def test_pressures(self):
        one = imported(cube("PLOAD4,20,1,3.,,,,5,7\nPLOAD4,20,1,1.,1.,1.,1.,7,5\n"))
        (name,) = one.options["load"]
        self.assertEqual(one.options["load"][name]["pressure"], 4.0)
        self.assertEqual(sorted(one.groups[name][0]), [5, 6, 7, 8])
        for text, reason in (
            ("PLOAD4,20,1,3.,4.,,,5,7\n", "varies over a face"),
            ("PLOAD4,20,1,3.,,,,5,7\n,0,1.,0.,0.\n", "PLOAD4, N1: a load along a direction"),
            ("PLOAD4,20,1,3.,,,,5,6\n", "name no face of element 1"),
            ("PLOAD4,20,1,3.,,,,THRU,6\n", "THRU is for shells"),
            ("PLOAD4,20,9,3.,,,,5,7\n", "9 is not the number of a solid element"),
        ):
            (row,) = refusals(cube(text))
            self.assertIn(reason, row)

    def test_gravity_acts_on_masses_as_well(self):
        one = imported(cube("GRAV,20,,9.81,0.,0.,-2.\nGRID,9,,0.,0.,4.\nCONM2,1,9,,4.\n"))
        self.assertEqual(numbers(one.options["load"]["gravity"]).tolist(), [0, 0, -19.62])

    def test_rotation(self):
        one = imported(cube("RFORCE,20,2,,3.,0.,2.,0.\n"))
        load = one.options["load"]["psolid_1"]
        self.assertAlmostEqual(load["spin"], 12 * np.pi, 12)
        self.assertEqual(numbers(load["spin_origin"]).tolist(), [1, 0, 0])
        self.assertEqual(numbers(load["spin_axis"]).tolist(), [0, 1, 0])
        (row,) = refusals(cube("RFORCE,20,2,,3.,0.,2.,0.,2\n,1.5\n"))
        self.assertIn("RACC", row)


if __name__ == "__main__":
    unittest.main()
