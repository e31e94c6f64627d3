#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Pairing of eigenvalues, and the plots of a sweep from tables written here."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

scripts = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(scripts.parent / "python"))
sys.dont_write_bytecode = True
import squeal
from squeal import matching
from squeal.plot import stability


class Match(unittest.TestCase):
    def test_order_does_not_matter(self):
        wanted = np.array([1j, 2j, 3j])
        np.testing.assert_array_equal(matching.match(wanted, wanted[[2, 0, 1]]), [1, 2, 0])

    def test_flutter_pair_of_equal_frequency(self):
        """By frequency alone the two exchange their places: rounding decides which comes first."""
        wanted = np.array([-0.1 + (1 - 1e-12) * 1j, 0.1 + 1j])
        found = np.array([0.1 + (1 - 1e-12) * 1j, -0.1 + 1j])
        np.testing.assert_array_equal(matching.match(wanted, found), [1, 0])

    def test_nearest_first_is_not_enough(self):
        """Each alone would take the second found one; together they are closest in their order."""
        wanted, found = np.array([1.000j, 1.004j]), np.array([0.997j, 1.001j])
        np.testing.assert_array_equal(matching.match(wanted, found), [0, 1])

    def test_none_is_used_twice(self):
        partner = matching.match([1j, 1j], [1j, 2j])
        self.assertEqual(sorted(partner), [-1, 0])

    def test_missing_one_takes_none_from_the_others(self):
        np.testing.assert_array_equal(matching.match([1j, 1.1j, 1.2j], [1.1j, 1.2j]), [-1, 0, 1])

    def test_empty(self):
        self.assertEqual(len(matching.match([], [1j])), 0)
        np.testing.assert_array_equal(matching.match([1j], []), [-1])


class Compare(unittest.TestCase):
    exact = np.array([1j, 2j, -0.01 + 3j, 0.01 + 3j, 0.02 + 4j])

    def test_equal(self):
        result = matching.compare(self.exact, self.exact[::-1], 5)
        self.assertEqual(
            (result["exact"], result["found"], result["exact_unstable"], result["found_unstable"]),
            (5, 5, 2, 2),
        )
        self.assertEqual(
            (result["missed"], result["invented"], result["without_partner"]), (0, 0, 0)
        )
        self.assertEqual((result["relative_error"], result["growth_error"]), (0, 0))

    def test_missed_and_invented(self):
        """The pair at 3 is taken for two stable modes, the one at 2 for a flutter mode; as many
        unstable ones are counted."""
        found = np.array([1j, 0.01 + 2j, 2.99j, 3.01j, 0.02 + 4j])
        result = matching.compare(self.exact, found, 5)
        self.assertEqual((result["exact_unstable"], result["found_unstable"]), (2, 2))
        self.assertEqual(
            (result["missed"], result["invented"], result["without_partner"]), (1, 1, 0)
        )
        self.assertAlmostEqual(result["growth_error"], 0.01)
        self.assertAlmostEqual(result["relative_error"], 0.005)

    def test_edge(self):
        """What lies beyond the edge counts as partner only."""
        result = matching.compare([1j, 1.9999j, 5j], [1j, 2.0001j], 2)
        self.assertEqual((result["exact"], result["found"], result["without_partner"]), (2, 1, 0))

    def test_lost_mode(self):
        result = matching.compare(self.exact, self.exact[:4], 5)
        self.assertEqual(
            (result["without_partner"], result["missed"], result["invented"]), (1, 1, 0)
        )


class Plot(unittest.TestCase):
    head = "friction,speed,pressure,damping"

    def written(self, folder, frictions, speeds, dampings):
        modes, points = [], []
        for f in frictions:
            for v in speeds:
                for c in dampings:
                    growth = 100 * (f - 0.25 - 0.05 * c)
                    at = f"{f},{v},1,{c}"
                    verdict = "unstable" if growth > 0 else "stable"
                    modes.append(
                        f"{at},1,{growth},6e3,955,0,1e-10,1e-9,1,{verdict},{int(growth > 0)}"
                    )
                    cells = f"{int(growth > 0)},{growth},955,1e-10,,{verdict},0"
                    if (f, v) == (0.6, 3):  # no steady sliding there
                        cells = ",,,,,,"
                    points.append(f"{at},{cells}")
        names = (
            "mode,growth_rate_1_per_s,angular_frequency_rad_per_s,frequency_hz,damping_ratio,"
            "backward_error,error_estimate,certified,verdict,unstable"
        )
        (folder / "eigenvalues.csv").write_text("\n".join([f"{self.head},{names}", *modes, ""]))
        names = (
            "unstable_modes,largest_growth_rate_1_per_s,frequency_hz,worst_backward_error,"
            "worst_error_estimate,verdict,undecided_modes"
        )
        (folder / "stability_map.csv").write_text("\n".join([f"{self.head},{names}", *points, ""]))
        # Without it the results are not complete
        (folder / "summary.json").write_text('{"version": "0.1.0", "complete": true}')

    def figures(self, *sweep):
        with tempfile.TemporaryDirectory() as name:
            self.written(Path(name), *sweep)
            subprocess.run([scripts / "squeal-plot", name], check=True)
            return sorted(path.name for path in Path(name).glob("*.png"))

    def test_one_parameter_needs_no_map(self):
        self.assertEqual(self.figures([0.2, 0.6], [1], [1]), ["stability.png"])
        self.assertEqual(self.figures([0.2], [1], [0, 1]), ["stability.png"])

    def test_three_parameters(self):
        names = ["stability_map_damping_0.png", "stability_map_damping_1.png"]
        names += [f"stability_speed_{v}_damping_{c}.png" for v in (1, 3, 10) for c in (0, 1)]
        self.assertEqual(self.figures([0.2, 0.4, 0.6], [1, 3, 10], [0, 1]), sorted(names))

    branch_head = (
        "active_set,branch,friction,speed,pressure,damping,growth_rate_1_per_s,"
        "angular_frequency_rad_per_s,frequency_hz,overlap,in_band,swept"
    )

    def test_lines_along_branches(self):
        # One branch jumps at friction 0.3, where the active set changes; the other begins there and
        # is in no band at first.
        rows = [
            "1,1,0.2,1,1,1,0,6e3,955,1,1,1",
            "1,1,0.3,1,1,1,0,6e3,955,1,1,0",
            "2,1,0.3,1,1,1,5,6e3,955,1,1,0",
            "2,1,0.6,1,1,1,9,6e3,955,1,1,1",
            "2,2,0.3,1,1,1,0,7e3,1114,0,0,0",
            "2,2,0.6,1,1,1,0,7e3,1114,1,1,1",
        ]
        critical = [
            "active_set,branch,partner,kind,direction,friction,speed,pressure,damping,frequency_hz",
            "2,1,0,contact,loss,0.3,1,1,1,955",
        ]
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            self.written(folder, [0.2, 0.6], [1], [1])
            (folder / "branches.csv").write_text("\n".join([self.branch_head, *rows, ""]))
            (folder / "critical.csv").write_text("\n".join([*critical, ""]))
            lines, ends = stability.lines_and_sets(squeal.open(folder).branches)
            self.assertEqual(ends, [(0.2, 0.3), (0.3, 0.6)])
            self.assertEqual(
                [list(line["friction"]) for line in lines], [[0.2, 0.3, 0.3, 0.6], [0.3, 0.6]]
            )
            self.assertEqual(list(lines[0]["growth_rate_1_per_s"]), [0, 0, 5, 9])
            subprocess.run([scripts / "squeal-plot", name], check=True)
            self.assertTrue((folder / "stability.png").exists())

    def test_critical_friction(self):
        y = np.array([0.1, 0.2, 0.3, 0.4])
        self.assertEqual(stability.critical(y, np.array([0, 0, 1, 0.0])), (0.2, 0.3))
        self.assertEqual(stability.critical(y, np.array([0, np.nan, 1, 2])), (0.1, 0.3))
        self.assertIsNone(stability.critical(y, np.zeros(4)))
        self.assertIsNone(stability.critical(y, np.ones(4)))


if __name__ == "__main__":
    unittest.main()
