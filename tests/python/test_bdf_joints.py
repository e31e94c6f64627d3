#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Joints of Nastran decks: rigid elements, mean motions, equations, springs and masses."""
import sys
import unittest
from pathlib import Path

import numpy as np

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/deck")]
sys.dont_write_bytecode = True
from bdf_cards import COMPLEX, EIGRL, ORIGIN, TURN, card, frame_of, numbers
from small_bdf import CONTROL, POINTS, cube, force, imported, refusals
from small_decks import terms


class Joints(unittest.TestCase):
    GRIDS = "GRID,20,,.5,.5,3.\nGRID,21,,.5,.5,3.\nGRID,22,,.5,.5,5.\n"

    def test_rigid_elements(self):
        one = imported(cube("FORCE,20,20,,1.,0.,0.,1.\nRBE2,7,20,123456,5,6,7,8\n" + self.GRIDS))
        self.assertEqual(
            one.options["coupling"], {"rbe2_7": {"reference": "reference_20", "nodes": "rbe2_7"}}
        )
        self.assertEqual(one.groups["rbe2_7"], [5, 6, 7, 8])
        self.assertEqual(one.options["load"], {"reference_20": {"force": "0.0,0.0,1.0"}})
        self.assertNotIn("reference_20", one.options["constraint"])

    def test_components_of_rigid_elements(self):
        """They have the axes of the dependent grids."""
        text = cube(force() + "RBE2,7,20,13,5,6,7,8,2.5-6\n" + self.GRIDS)
        found = imported(text).options["coupling"]["rbe2_7"]
        self.assertEqual(found["components"], "xz")
        text += card("CORD2R", 7, 0, ORIGIN, TURN.T)
        text = text.replace("ENDDATA\n", "")
        text = text.replace("1.,1.,1.", "1.,1.,1.,7").replace(
            "GRID,8,,0.,1.,1.", "GRID,8,,0.,1.,1.,7"
        )
        one = imported(text)
        self.assertEqual(one.options["coupling"]["rbe2_7_2"]["frame"], "cord_7")
        self.assertEqual((one.groups["rbe2_7"], one.groups["rbe2_7_2"]), ([5, 6], [7, 8]))

    def test_grids_of_cells_with_rotations(self):
        """An independent grid of solid cells becomes a reference node that its cells follow."""
        one = imported(cube("MOMENT,20,5,,1.,0.,0.,1.\nRBE2,7,5,123,6,7\n"))
        couplings = one.options["coupling"]
        self.assertEqual({one["reference"] for one in couplings.values()}, {"reference_5"})
        self.assertEqual(one.groups[couplings["grid_5"]["nodes"]], [5])
        self.assertEqual(one.options["load"], {"reference_5": {"moment": "0.0,0.0,1.0"}})

    def test_dependent_reference_nodes(self):
        cards = "RBE2,7,20,{},5,6,22\nCONM2,3,22,,4.\n" + self.GRIDS
        for components, pinned in (("123", True), ("123456", None)):
            one = imported(cube(force() + cards.format(components)))
            self.assertIn("reference_22", one.options["coupling"]["rbe2_7"]["nodes"])
            self.assertEqual(one.options["coupling"]["rbe2_7"].get("pinned"), pinned)
            held = one.options["constraint"].get("reference_22", {})
            self.assertEqual(held.get("clamped_rotation"), "xyz" if pinned else None)
        (row,) = refusals(cube(force() + cards.format("1234")))
        self.assertIn("some rotations of grid 22", row)

    def test_rigid_bars(self):
        one = imported(cube(force() + "RBAR,7,20,5,123456\n" + self.GRIDS))
        self.assertEqual(one.groups["rbar_7"], [5])
        one = imported(cube(force() + "RBAR,7,5,20,,123456,12\n" + self.GRIDS))
        self.assertEqual(one.options["coupling"]["rbar_7"]["components"], "xy")
        (row,) = refusals(cube(force() + "RBAR,7,20,5,123,456\n" + self.GRIDS))
        self.assertIn("must belong to one end", row)

    def test_mean_motions(self):
        card = "RBE3,7,,20,123456,1.,123,5,6\n,7,2.,123,8\n"
        one = imported(cube("FORCE,20,20,,1.,0.,0.,1.\n" + card + self.GRIDS))
        found = one.options["coupling"]["rbe3_7"]
        self.assertEqual((found["kind"], found["reference"]), ("distributed", "reference_20"))
        weights = dict(zip(found["nodes"].split(","), numbers(found["weights"])))
        self.assertEqual(
            {tuple(one.groups[name]): weight for name, weight in weights.items()},
            {(5, 6, 7): 1.0, (8,): 2.0},
        )

    def mean(self, reference, wanted, groups, axes, at):
        """Returns the components of the reference as rows of coefficients of (node, component), by
        the formula of the mean motion with turned axes (weights times squares are least)."""
        rows, forces = np.zeros((6, 6)), {}
        for weight, components, nodes in groups:
            for node in nodes:
                arm = np.array(POINTS[node - 1], float) - reference
                for component in components:
                    e = axes.get(node, np.eye(3))[component]
                    form = np.concatenate([e, np.cross(arm, e)])
                    rows += weight * np.outer(form, form)
                    for one in range(3):
                        key = node, one
                        forces[key] = forces.get(key, 0) + weight * form * e[one]
        inverse = np.linalg.inv(rows)
        return {key: inverse @ value for key, value in forces.items()}

    def test_mean_motions_of_some_components_in_turned_axes(self):
        card_ = card("CORD2R", 7, 0, ORIGIN, TURN.T)
        rbe3 = "RBE3,7,,20,126,1.5,123,5,7\n,2.,13,6,8\n"
        text = cube(force() + rbe3 + self.GRIDS + card_)
        text = text.replace("1.,1.,1.", "1.,1.,1.,7").replace(
            "GRID,8,,0.,1.,1.", "GRID,8,,0.,1.,1.,7"
        )
        text = text.replace("GRID,20,,.5,.5,3.", "GRID,20,,.5,.5,3.,7")
        one = imported(text)
        axes = {7: TURN.T, 8: TURN.T}
        groups = [(1.5, (0, 1, 2), (5, 7)), (2.0, (0, 2), (6, 8))]
        wanted = self.mean(np.array([0.5, 0.5, 3.0]), "126", groups, axes, None)
        for component in (0, 1, 5):
            found = terms(one.options["equation"][f"rbe3_7_{component + 1}"])
            block, axis = 3 * (component // 3), TURN.T[component % 3]
            scale = found[f"reference_20:{('x', 'rx')[component // 3]}"] / axis[0]
            for (node, at), value in wanted.items():
                mine = found.get(f"node_{node}:{'xyz'[at]}", 0.0) / scale
                self.assertAlmostEqual(mine, -axis @ value[block : block + 3], 11)
            names = ("x", "y", "z") if component < 3 else ("rx", "ry", "rz")
            mine = [found[f"reference_20:{name}"] / scale for name in names]
            np.testing.assert_allclose(mine, axis, atol=1e-12)

    def test_equations_of_rigid_motions(self):
        """Rigid motions satisfy the equations of a mean motion."""
        one = imported(cube(force() + "RBE3,7,,20,1346,1.,123,5,6\n,7\n" + self.GRIDS))
        shift, turn = np.array([0.3, -0.5, 0.2]), np.array([0.1, 0.7, -0.4])
        places = {f"node_{at}": np.array(POINTS[at - 1], float) for at in range(1, 9)}
        places["reference_20"] = np.array([0.5, 0.5, 3.0])
        self.assertEqual(len(one.options["equation"]), 4)
        for equation in one.options["equation"].values():
            total = 0.0
            for place, value in terms(equation).items():
                name, component = place.split(":")
                motion = shift + np.cross(turn, places[name])
                values = dict(zip(("x", "y", "z", "rx", "ry", "rz"), (*motion, *turn)))
                total += value * values[component]
            self.assertAlmostEqual(total, 0, 12)

    def test_mean_motions_that_are_refused(self):
        for card_, reason in (
            ("RBE3,7,,20,123456,1.,123456,5,6\n", "rotations of the grids"),
            ("RBE3,7,,20,1,1.,1,5,6\n", "do not determine the motion"),
            ("RBE3,7,,5,1236,1.,123,6,7\n,8\n", "grid 5 of solid elements has no rotations"),
            ("RBE3,7,,20,123456,-1.,123,6,7\n,8\n", "weights must be positive"),
        ):
            (row,) = refusals(cube(force() + card_ + self.GRIDS))
            self.assertIn(reason, row)

    def test_equations(self):
        """MPC is in the axes of its grids; only the selected sets count."""
        control = CONTROL.replace("LOAD", "MPC = 30\nLOAD")
        cards = "MPC,3,5,1,2.,6,1,-1.\n,,7,3,.5\nMPC,4,5,2,1.,6,2,1.\nMPC,5,5,3,1.,6,3,1.\n"
        one = imported(cube(force() + cards + "MPCADD,30,3,4\n", control=control))
        found = [terms(one) for one in one.options["equation"].values()]
        self.assertEqual(found[0], {"node_5:x": 2.0, "node_6:x": -1.0, "node_7:z": 0.5})
        self.assertEqual(len(found), 2)
        text = cube(force() + cards + card("CORD2R", 7, 0, ORIGIN, TURN.T), control=control)
        text = text.replace("MPC = 30", "MPC = 3").replace("1.,1.,1.", "1.,1.,1.,7")
        (found,) = imported(text).options["equation"].values()
        mine = [terms(found)[f"node_7:{axis}"] for axis in "xyz"]
        np.testing.assert_allclose(mine, 0.5 * TURN.T[2], atol=1e-12)

    def test_masses(self):
        """I21, I31 and I32 are positive sums; the tensor has them with a minus."""
        cards = "CONM2,3,20,,4.,.1,.2,.3,\n,11.,-1.,12.,2.,3.,13.\n" + self.GRIDS
        found = imported(cube(force() + cards)).options["mass"]["reference_20"]
        self.assertEqual(found["total"], 4.0)
        self.assertEqual(numbers(found["offset"]).tolist(), [0.1, 0.2, 0.3])
        self.assertEqual(numbers(found["inertia"]).tolist(), [11, 12, 13, 1, -2, -3])
        tensor = np.array([[11, 1, -2], [1, 12, -3], [-2, -3, 13]])
        text = cube(
            force() + cards.replace("20,,4.", "20,7,4.") + card("CORD2R", 7, 0, ORIGIN, TURN.T)
        )
        found = imported(text).options["mass"]["reference_20"]
        np.testing.assert_allclose(numbers(found["offset"]), TURN @ [0.1, 0.2, 0.3], atol=1e-12)
        wanted = TURN @ tensor @ TURN.T
        order = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
        mine = numbers(found["inertia"])
        np.testing.assert_allclose(mine, [wanted[at] for at in order], atol=1e-12)
        found = imported(text.replace("20,7,4.", "20,-1,4.")).options["mass"]["reference_20"]
        np.testing.assert_allclose(
            numbers(found["offset"]), np.array([-0.4, -0.3, -2.7]), atol=1e-12
        )

    def test_masses_of_one_grid(self):
        """Two masses apart from each other have the inertia of their distance."""
        cards = "CONM2,3,20,,1.,1.\nCONM2,4,20,,3.,-1.\n" + self.GRIDS
        found = imported(cube(force() + cards)).options["mass"]["reference_20"]
        self.assertEqual((found["total"], found["offset"]), (4.0, "-0.5,0.0,0.0"))
        np.testing.assert_allclose(numbers(found["inertia"]), [0, 3, 3, 0, 0, 0], atol=1e-14)

    def test_masses_of_cells(self):
        one = imported(cube(force() + "CONM2,3,5,,2.\nCONM2,4,6,,2.\nCONM2,5,7,,3.\n"))
        found = {
            tuple(one.groups[name]): value["total"] for name, value in one.options["mass"].items()
        }
        self.assertEqual(found, {(5, 6): 4.0, (7,): 3.0})
        (row,) = refusals(cube(force() + "CONM2,3,5,,2.,.1\n"))
        self.assertIn("node 5 of solid cells has no rotations", row)

    def test_scalar_springs(self):
        one = imported(cube(force() + "CELAS2,9,30.,5,2\nPELAS,4,7.,,,8,9.\nCELAS1,10,8,5,1\n"))
        found = one.options["bushing"]
        self.assertEqual(found["celas2_9"], {"from": "node_5", "stiffness": "0.0,30.0,0.0"})
        self.assertEqual(found["celas1_10"]["stiffness"], "9.0,0.0,0.0")
        cards = "CDAMP2,9,30.,20,6,21,6\nPDAMP,1,2.,2,3.\nCDAMP1,10,2,20,1,21,1\n" + self.GRIDS
        found = imported(cube(force() + cards)).options["bushing"]
        self.assertEqual(found["cdamp2_9"]["damping"], "0.0,0.0,0.0,0.0,0.0,30.0")
        self.assertEqual(found["cdamp1_10"]["to"], "reference_21")

    def test_springs_between_different_components(self):
        """Their difference is a component of a node of its own."""
        one = imported(cube(force() + "CELAS2,9,30.,5,2,7,1\n"))
        (equation,) = one.options["equation"].values()
        self.assertEqual(terms(equation), {"reference_9:x": 1.0, "node_5:y": -1.0, "node_7:x": 1.0})
        self.assertEqual(
            one.options["bushing"]["celas2_9"], {"from": "reference_9", "stiffness": "30.0,0.0,0.0"}
        )
        held = one.options["constraint"]["reference_9"]
        self.assertEqual((held["clamped"], held["clamped_rotation"]), ("yz", "xyz"))

    def test_bushings(self):
        law = "PBUSH,4,K,1.,2.,3.,4.,5.,6.\n,,B,.1,,.3\n,,RCV,1.\n"
        cards = law + "CBUSH,9,4,20,21,,,,0\nCBUSH,10,4,20,22,,,,7\n" + self.GRIDS
        found = imported(cube(force() + cards + card("CORD2R", 7, 0, ORIGIN, TURN.T)))
        one = found.options["bushing"]["cbush_9"]
        self.assertEqual((one["from"], one["to"]), ("reference_20", "reference_21"))
        self.assertEqual(numbers(one["stiffness"]).tolist(), [1, 2, 3, 4, 5, 6])
        self.assertEqual(numbers(one["damping"]).tolist(), [0.1, 0, 0.3])
        self.assertNotIn("frame", one)
        name = found.options["bushing"]["cbush_10"]["frame"]
        np.testing.assert_allclose(frame_of(found.options, name), TURN.T, atol=1e-12)

    def test_axes_of_bushings(self):
        """x along the line of the ends, y towards the vector, or the grid GO."""
        law = "PBUSH,4,K,1.,2.,3.\n"
        for words in ("1.,0.,1.", "23"):
            cards = law + f"CBUSH,10,4,20,22,{words}\nGRID,23,,1.5,.5,3.5\n" + self.GRIDS
            found = imported(cube(force() + cards)).options
            axes = frame_of(found, found["bushing"]["cbush_10"]["frame"])
            np.testing.assert_allclose(axes, [[0, 0, 1], [1, 0, 0], [0, 1, 0]], atol=1e-12)
        for cards, reason in (
            (law + "CBUSH,10,4,20,22\n", "need an orientation"),
            (law + "CBUSH,10,4,20,21\n", "need CID"),
            (law + "CBUSH,10,4,20,22,1.,0.,0.\n,.3\n", "S must be 0.5"),
            (law + "CBUSH,10,4,5,22,1.,0.,0.\n", "must be grids with rotations"),
            (law + "CBUSH,10,4,20,22,1.,0.,0.\n,,3,1.\n", "an offset (OCID)"),
            ("CBUSH,10,5,20,22,1.,0.,0.\n", "there is no PBUSH 5"),
        ):
            (row,) = refusals(cube(force() + cards + self.GRIDS))
            self.assertIn(reason, row)

    def test_structural_damping_of_bushings(self):
        law = "PBUSH,4,K,100.,200.\n,,GE,.05\nPARAM,W4,10.\n"
        cards = law + "CBUSH,9,4,20,21,,,,0\n" + self.GRIDS + EIGRL
        found = imported(cube(cards, control=COMPLEX)).options["bushing"]["cbush_9"]
        np.testing.assert_allclose(numbers(found["damping"]), [0.5, 1.0, 0])


if __name__ == "__main__":
    unittest.main()
