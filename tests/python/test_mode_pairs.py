#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""MAC and pairs of modes, on small results written here."""
import sys
import unittest
from pathlib import Path

import numpy as np

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / folder) for folder in ("python", "tests/support/run")]
sys.dont_write_bytecode = True
import squeal
from squeal.mac import mac, nodal_volumes, same_nodes
from squeal.pairs import pair
from squeal.results import Mesh
from written_results import ACROSS, AGAINST, ALONG, CELLS, HZ, PLACES, OnWrittenResults


class Pairs(OnWrittenResults):
    def test_nodal_volumes_of_all_cells(self):
        """Reference cells under an affine map of determinant 2: their volumes are doubled."""
        corners = {
            "triangle": ([(0, 0), (1, 0), (0, 1)], 0.5, (2, 9)),
            "square": ([(0, 0), (1, 0), (1, 1), (0, 1)], 1, (3, 10, 16)),
            "tetrahedron": ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], 1 / 6, (4, 11)),
            "cube": (
                [(*p, z) for z in (0, 1) for p in ((0, 0), (1, 0), (1, 1), (0, 1))],
                1,
                (5, 12, 17),
            ),
            "prism": (
                [(*p, z) for z in (0, 1) for p in ((0, 0), (1, 0), (0, 1))],
                0.5,
                (6, 13, 18),
            ),
            "pyramid": (
                [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1)],
                1 / 3,
                (7, 14, 19),
            ),
        }
        for name, (places, volume, kinds) in corners.items():
            places = np.array(places, float)
            stretch = np.diag([2.0, 1, 1][: places.shape[1]])
            stretch[0, 1] = 0.3
            for kind in kinds:
                extra = 0 if kind < 8 else 3  # nodes amid edges have parts of the volume, too
                nodes = np.arange(len(places) + extra)[None]
                more = np.vstack([places @ stretch.T, np.full((extra, places.shape[1]), 7.0)])
                found = nodal_volumes(Mesh(more, {kind: {"nodes": nodes}}, ["body"]))
                np.testing.assert_allclose(found, 2 * volume / nodes.size, rtol=1e-14, err_msg=name)

    def test_mac_by_hand(self):
        """((0.5 + 2 - 1.5) / 4)² = 1/16 with nodal volumes, ((8 - 4) / 12)² = 1/9 without."""
        volumes = nodal_volumes(Mesh(PLACES, {5: {"nodes": CELLS}}, ["bar"]))
        np.testing.assert_allclose(volumes, np.repeat([0.125, 0.5, 0.375], 4), rtol=1e-14)
        turned = 3 * np.exp(0.7j) * AGAINST  # neither phase nor size matters
        found = mac([ALONG], [ALONG, turned, ACROSS, ALONG + 1j * ACROSS], volumes)
        np.testing.assert_allclose(found, [[1, 1 / 16, 0, 1 / 2]], atol=1e-15)
        np.testing.assert_allclose(mac([ALONG], [turned]), [[1 / 9]], rtol=1e-14)
        with self.assertRaisesRegex(squeal.ResultsError, "zero or not finite"):
            mac([ALONG], [0 * ALONG])

    def test_runs_of_one_mesh_have_macs_whatever_the_order_of_nodes(self):
        order = np.random.default_rng(1).permutation(12)
        one = squeal.open(self.write("one", {0.4: [(HZ * 90, "stable", ALONG)]}))
        other = squeal.open(
            self.write(
                "other",
                {0.4: [(HZ * 50, "stable", ACROSS), (HZ * 95, "stable", AGAINST)]},
                order=order,
            )
        )
        found = one.mac(other, friction=0.4)
        self.assertEqual((list(found.index), list(found.columns)), ([1], [1, 2]))
        np.testing.assert_allclose(found, [[0, 1 / 16]], atol=1e-15)
        far = squeal.open(self.write("far", {0.4: [(HZ * 90, "stable", ALONG)]}, stretch=1.01))
        with self.assertRaisesRegex(
            squeal.ResultsError, r"one mesh, but the meshes of .*one and .*far differ \(12 and 12"
        ):
            one.mac(far, friction=0.4)
        with self.assertRaisesRegex(squeal.ResultsError, "bent is not a kind of modes: complex"):
            one.mac(other, kind="bent")
        with self.assertRaisesRegex(squeal.ResultsError, "one holds no shape of a free mode"):
            one.mac(other, kind="free")

    def test_nodes_of_one_tag_and_place_differ_by_their_bodies(self):
        """Two hexahedra of two bodies, with nodes of their own where they touch; in one body, as
        where a bolt is cut, the eight nodes there are left out."""
        places, cells = PLACES[np.r_[0:8, 4:12]], np.array([CELLS[0], CELLS[1] + 4])
        tags, order = np.r_[0:8, 4:12], np.random.default_rng(2).permutation(16)
        for bodies, left in (([[0], [1]], 16), ([[0], [0]], 8)):
            block = {"body": np.array(bodies)}
            one = Mesh(places, {5: {"nodes": cells, **block}}, ["a", "b"], tags)
            moved = {5: {"nodes": np.argsort(order)[cells], **block}}
            rows, same = same_nodes(one, Mesh(places[order], moved, ["a", "b"], tags[order]))
            self.assertEqual(len(rows), left)
            np.testing.assert_array_equal(order[same], rows)
            self.assertIsNone(same_nodes(one, Mesh(places, one.cells, ["a", "c"], tags)))

    def test_pairs(self):
        """The MAC decides before the frequency; a known low MAC forbids a pair."""
        s, none = np.array([HZ * 100, HZ * 110]), np.full((2, 2), np.nan)
        self.assertEqual(list(pair(s, s, none)[0]), [0, 1])
        partner, by = pair(s, s, np.array([[0.1, 0.9], [0.8, 0.1]]))
        self.assertEqual((list(partner), list(by)), ([1, 0], ["MAC", "MAC"]))
        mixed = np.array([[0.1, np.nan], [np.nan, np.nan]])
        self.assertEqual(list(pair(s, s, mixed)[0]), [-1, 1])
        for hertz, expected in ((104.9, 0), (105.1, -1)):  # 5 %
            self.assertEqual(pair(s[:1], [HZ * hertz], none[:1, :1])[0], [expected])
        self.assertEqual(pair([0], [0], none[:1, :1])[0], [0])  # rigid-body modes
        # Modes of one name are a pair up to 20 % apart, before the nearest frequency decides.
        for hertz, expected in ((119, ([1], ["name"])), (121, ([0], ["frequency"]))):
            found, by = pair(s[:1], [HZ * 101, HZ * hertz], none[:1], (["bend"], ["twist", "bend"]))
            self.assertEqual((list(found), list(by)), expected)
        self.assertEqual(list(pair(s, s, none, (["", ""], ["", ""]))[1]), ["frequency"] * 2)
        self.assertEqual(pair(s[:1], s[:1], mixed[:1, :1], (["bend"], ["bend"]))[0], [-1])

    def test_compare(self):
        one = squeal.open(
            self.write(
                "one",
                {
                    0.2: [(HZ * 100, "neutral")],
                    0.4: [
                        (HZ * 100 - 2, "stable"),
                        (HZ * 200 + 3, "unstable", ALONG),
                        (HZ * 510, "neutral"),
                        (HZ * 700, "neutral"),
                    ],
                },
                free=[(90.0, ALONG), (180.0, ACROSS)],
            )
        )
        other = squeal.open(
            self.write(
                "other",
                {
                    0.4: [
                        (HZ * 150 + 5, "unstable", ALONG + 0.1 * ACROSS),
                        (HZ * 202 + 1, "unstable", ACROSS),
                        (HZ * 495, "neutral"),
                    ],
                    0.6: [(HZ * 101, "neutral")],
                },
                free=[(95.0, ACROSS), (97.0, ALONG)],
                tops={0.4: 500.0},
            )
        )
        table = one.compare(other)
        self.assertEqual(list(table["kind"]), ["free"] * 2 + ["complex"] * 4)
        free, found = table[:2], table[2:]
        self.assertEqual(list(free["mode"]), [1, 2])
        self.assertEqual(list(free["other_mode"]), [2, 1])
        np.testing.assert_allclose(free["frequency_change_hz"], [7, -85], rtol=1e-12)
        self.assertEqual(set(found["friction"]), {0.4})  # 0.2 and 0.6 are not common
        # 510 Hz is above the common band, but its partner is in it; 700 Hz is not compared.
        np.testing.assert_allclose(found["frequency_hz"], [100, 200, 510, np.nan], rtol=1e-12)
        np.testing.assert_allclose(found["other_frequency_hz"], [np.nan, 150, 495, 202], rtol=1e-12)
        np.testing.assert_allclose(
            found["frequency_change_hz"], [np.nan, -50, -15, np.nan], rtol=1e-12
        )
        np.testing.assert_allclose(
            found["growth_change_1_per_s"], [np.nan, 2, 0, np.nan], atol=1e-12
        )
        np.testing.assert_allclose(found["mac"], [np.nan, 1 / 1.01, np.nan, np.nan], rtol=1e-12)
        self.assertEqual(list(found["matched_by"]), ["", "MAC", "frequency", ""])

    def test_points_of_many_digits(self):
        """Keys of points have twelve digits."""
        friction = 0.1 + 4e-13
        one, other = (
            squeal.open(self.write(name, {friction: [(HZ * 100, "stable", ALONG)]}))
            for name in ("one", "other")
        )
        self.assertEqual(list(one.compare(other)["matched_by"]), ["MAC"])

    def test_names_of_modes(self):
        """Two meshes: the named modes have changed places."""
        runs = [
            squeal.open(
                self.write(name, {0.4: [(HZ * 100, "stable"), (HZ * 110, "stable")]}, stretch=k)
            )
            for k, name in ((1, "one"), (2, "other"))
        ]
        for run, names in zip(runs, (["bend", np.nan], [np.nan, "bend"])):
            run.eigenvalues = run.eigenvalues.assign(name=names)
        table = runs[0].compare(runs[1])
        self.assertEqual(list(table["other_name"].fillna("none")), ["bend", "none", ""])
        # 110 and 100 Hz are too far from each other for modes without names.
        self.assertEqual(list(table["matched_by"]), ["name", "", ""])


if __name__ == "__main__":
    unittest.main(verbosity=2)
