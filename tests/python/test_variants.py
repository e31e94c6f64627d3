#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""MAC, pairs of modes and rankings of variants, on small results written here."""
import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np
import pandas as pd

repository = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(repository / "python"))
sys.dont_write_bytecode = True
import squeal
from squeal import compare, variants
from squeal.mac import mac, nodal_volumes, same_nodes
from squeal.pairs import pair
from squeal.results import Mesh

COMMAND = repository / "scripts/squeal-compare"
PAGE = f"<html>{compare.MARK}"  # an earlier page
HZ = 2j * np.pi
# A bar of two hexahedra, 1 m and 3 m long, of cross-section 1 m²: four nodes at x = 0, 1 and 4 m.
PLACES = np.array(
    [(x, y, z) for x in (0, 1, 4) for y, z in ((0, 0), (1, 0), (1, 1), (0, 1))], float
)
CELLS = np.array([[0, 4, 5, 1, 3, 7, 6, 2], [4, 8, 9, 5, 7, 11, 10, 6]])
ALONG = np.zeros((12, 3)) + [1, 0, 0]
# As ALONG, but against x at 4 m: nodal volumes 0.5 and 2 m³ move along, 1.5 m³ against it.
AGAINST = ALONG * np.where(PLACES[:, :1] == 4, -1, 1)
ACROSS = np.zeros((12, 3)) + [0, 1, 0]


def write(folder, points, **more):
    """Writes results. `points`: for each friction the modes (s, verdict[, shape]). `more`: tops of
    the bands by friction, options, critical frictions (friction, error, Hz), free modes (Hz,
    shape), order of the nodes, a stretch of the mesh, complete."""
    folder.mkdir()
    order = more.get("order", np.arange(12))
    options = {"flutter_friction": ",".join(map(str, points)), **more.get("options", {})}
    (folder / "options.txt").write_text(
        "\n".join(["# squeal 0.1.0, 1 ranks", *(f"-{name} {v}" for name, v in options.items())])
    )
    tops, entries, rows, states = more.get("tops", {}), [], [], []
    with h5py.File(folder / "results.h5", "w") as file:
        mesh = file.create_group("mesh")
        mesh.attrs["bodies"] = np.bytes_(b"bar")
        mesh["coordinates"] = (PLACES * more.get("stretch", 1.0))[order]
        mesh["node_tag"] = (10 + order)[:, None]
        mesh["cells_5/nodes"] = np.argsort(order)[CELLS]
        mesh["cells_5/body"] = mesh["cells_5/tag"] = np.zeros((2, 1), int)
        for friction, modes in points.items():
            at = {"friction": friction, "speed": 1, "pressure": 1, "damping": 1}
            group = file.create_group(f"flutter/friction_{friction:g}")
            group.attrs.update({name: float(value) for name, value in at.items()})
            for number, (s, verdict, *shape) in enumerate(modes, 1):
                rows.append(
                    {
                        **at,
                        "mode": number,
                        "growth_rate_1_per_s": s.real,
                        "angular_frequency_rad_per_s": s.imag,
                        "frequency_hz": s.imag / (2 * np.pi),
                        "damping_ratio": -s.real / abs(s),
                        "error_estimate": more.get("error", 1e-9),
                        "verdict": verdict,
                        "unstable": int(verdict == "unstable"),
                    }
                )
                if shape:
                    group[f"mode_{number:03d}_real"] = np.real(shape[0])[order]
                    group[f"mode_{number:03d}_imaginary"] = np.imag(shape[0])[order]
            worst = max((s.real for s, *_ in modes), default=np.nan)
            grows = [number for number, mode in enumerate(modes, 1) if mode[1] == "unstable"]
            entries.append(
                {
                    **at,
                    "eigenvalues": len(modes),
                    "band_top_hz": tops.get(friction, 1000.0),
                    "unstable_modes": [{"mode": number} for number in grows],
                }
            )
            states.append(
                {
                    **at,
                    "unstable_modes": len(grows),
                    "largest_growth_rate_1_per_s": worst,
                    "frequency_hz": 1,
                    "verdict": modes[0][1],
                    "undecided_modes": 0,
                }
            )
        for number, (hertz, shape) in enumerate(more.get("free", ()), 1):
            file[f"modes/active_set_1/mode_{number:03d}"] = shape[order]
    tables = {"eigenvalues": rows, "stability_map": states}
    tables["modes"] = [
        {"mode": k, "angular_frequency_rad_per_s": 2 * np.pi * hertz, "frequency_hz": hertz}
        for k, (hertz, _) in enumerate(more.get("free", ()), 1)
    ]
    tables["critical"] = [
        {
            "active_set": 1,
            "kind": "hopf",
            "direction": "loss",
            **dict(at, friction=friction),
            "frequency_hz": hertz,
            "friction_error_estimate": error,
        }
        for friction, error, hertz in more.get("critical", ())
    ]
    for name, table in tables.items():
        if table:
            pd.DataFrame(table).to_csv(folder / f"{name}.csv", index=False, na_rep="nan")
    summary = {"version": "0.1.0", "case": "bar", "complete": more.get("complete", True)}
    summary |= {"frictions": entries, "options": options}
    summary["verdict"] = {"sentence": "Known."}
    (folder / "summary.json").write_text(json.dumps(summary))
    return folder


class Variants(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.place = Path(temporary.name)

    def write(self, name, points, **more):
        return write(self.place / name, points, **more)

    def read(self, *folders):
        return variants.read_variants(folders)

    def ranks(self, *folders):
        table = variants.rankings(self.read(*folders))
        return {
            criterion: dict(zip(rows["variant"], rows["rank"]))
            for criterion, rows in table.groupby("criterion")
        }

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

    def test_rankings(self):
        low = self.write("low", {0.4: [(HZ * 100 + 2, "unstable"), (HZ * 200 + 1, "unstable")]})
        high = self.write("high", {0.4: [(HZ * 100 + 5, "unstable")]}, critical=[(0.3, 1e-8, 90)])
        calm = self.write("calm", {0.4: [(HZ * 100 - 1, "stable")]})
        self.assertEqual(
            self.ranks(low, high, calm),
            {
                "largest growth rate": {"calm": 1, "low": 2, "high": 3},
                "number of unstable modes": {"calm": 1, "high": 2, "low": 3},
                # `low` loses stability between 0 and 0.4, `high` at 0.3, which is in this range.
                "critical friction": {"calm": 1, "high": 2, "low": 2},
            },
        )
        table = variants.rankings(self.read(low, high, calm)).set_index(["criterion", "variant"])
        self.assertEqual(table.loc[("critical friction", "low"), "words"], "between 0 and 0.4")
        self.assertEqual(table.loc[("critical friction", "high"), "words"], "0.3")
        self.assertEqual(
            table.loc[("critical friction", "calm"), "words"], "stable up to friction 0.4"
        )
        self.assertEqual(
            compare.sentence_of(table.reset_index()),
            "Quietest by largest growth rate: calm; by number of unstable modes: calm; by critical"
            " friction: calm.",
        )

    def test_ties_are_ties(self):
        self.assertEqual(
            variants.ranks_of([(3, 0), (1, 0.2), (1.1, 0), (2, 0)], False), [4, 1, 1, 3]
        )
        self.assertEqual(variants.ranks_of([(np.inf, 0), (0.3, 0.1), (np.inf, 0)], True), [1, 3, 1])
        # Growth rates 5 and 5 + 6e-7 1/s, with errors of 1e-9 · 628 1/s each
        one, other = (
            self.write(name, {0.4: [(HZ * 100 + growth, "unstable")]})
            for name, growth in (("one", 5), ("other", 5 + 6e-7))
        )
        self.assertEqual(self.ranks(one, other)["largest growth rate"], {"one": 1, "other": 1})

    def test_round_off_is_no_change(self):
        """Growth rates 1e-13 apart, without an estimate of their errors, in bands without a top: a
        tie, shown as equal."""
        none = {0.4: None}
        one, other = (
            self.write(name, {0.4: [(HZ * 100 + growth, "uncertified")]}, error=np.nan, tops=none)
            for name, growth in (("one", 5), ("other", 5 + 1e-13))
        )
        self.assertEqual(self.ranks(one, other)["largest growth rate"], {"one": 1, "other": 1})
        found = self.read(one, other)
        self.assertEqual(list(variants.results_table(found).loc["eigenvalues"]), [1, 1])
        cell = compare.page_data(found)["modes"][-1]["rows"][0][1]
        self.assertEqual((cell["growth_change_1_per_s"], cell["matched_by"]), (0, "frequency"))

    def test_doubt_moves_no_variant_up(self):
        """Undecided modes count as unstable, and uncertified ones that grow by more than
        round-off."""
        certain = self.write("certain", {0.4: [(HZ * 100 + 3, "unstable")]})
        for word, growths in (("undecided", (4, -1e-9)), ("uncertified", (4, 2))):
            doubtful = self.write(word, {0.4: [(HZ * 100 + g, word) for g in growths]})
            ranks = self.ranks(doubtful, certain)
            self.assertEqual(ranks["largest growth rate"], {"certain": 1, word: 2})
            self.assertEqual(ranks["number of unstable modes"], {"certain": 1, word: 2})
            self.assertEqual(ranks["critical friction"], {"certain": 1, word: 1})
            table = variants.rankings(self.read(doubtful, certain)).set_index("variant")
            self.assertEqual(set(table.loc[word, "remark"]), {f"2 of 2 eigenvalues are {word}"})
            self.assertEqual(set(table.loc["certain", "remark"]), {""})
        calm = self.write("calm", {0.4: [(HZ * 100 - 3, "uncertified")]})
        self.assertEqual(self.ranks(certain, calm)["number of unstable modes"]["calm"], 1)

    def test_only_common_points_and_the_common_band_count(self):
        one = self.write(
            "one",
            {
                0.2: [(HZ * 100, "neutral")],
                0.4: [(HZ * 100, "neutral"), (HZ * 600 + 9, "unstable")],
            },
        )
        other = self.write(
            "other",
            {0.4: [(HZ * 100 + 1, "unstable")], 0.5: [(HZ * 100 + 7, "unstable")]},
            tops={0.4: 500.0},
            critical=[(0.3, 1e-8, 100), (0.1, 1e-8, 600)],
            stretch=2,
        )
        found = self.read(one, other)
        notes = "\n".join(variants.notes_of(found))
        for text in (
            "1 of 3 points of the sweeps are common: friction 0.4.",
            "points of one, which are not compared: friction 0.2.",
            "points of other, which are not compared: friction 0.5.",
            "The bands differ at 1 of 1 points; the common band ends there at 500 Hz.",
            "not compared: one 1 (1 unstable), other 0 (0 unstable).",
            "Modes of one and other are matched by frequency: the meshes of one and other differ",
        ):
            self.assertIn(text, notes)
        table = variants.results_table(found)
        self.assertEqual(list(table.loc["unstable modes at all points"]), [0, 1])
        self.assertEqual(list(table.loc["critical friction"]), [np.inf, 0.3])
        np.testing.assert_allclose(table.loc["largest growth rate [1/s]"], [np.nan, 1])
        remarks = variants.rankings(found).set_index("variant")["remark"]
        self.assertEqual(
            set(remarks["one"]), {"unstable modes above the common band, not ranked: 1"}
        )
        self.assertEqual(set(remarks["other"]), {""})

    def test_options_that_differ(self):
        stable = {0.4: [(HZ * 100, "stable")]}
        one = self.write("one", stable, options={"mesh_order": "2", "contact_gap": "1.0e-6"})
        other = self.write(
            "other", stable, options={"mesh_order": "1", "contact_gap": "1e-6", "report_dir": "x"}
        )
        table = variants.options_table(self.read(one, other))
        self.assertEqual(table.index.tolist(), ["-mesh_order"])
        self.assertEqual(table.loc["-mesh_order"].tolist(), ["2", "1"])
        data = compare.page_data(self.read(one, other))
        self.assertEqual(data["options"], [["-mesh_order", ["2", "1"], [None, -50.0]]])
        self.assertEqual(data["modes"][-1]["name"], "friction 0.4")

    def refused(self, *words):
        """Returns why the command refuses folders and files."""
        paths = [word if word == "-o" else str(self.place / word) for word in words]
        if "-o" not in words:
            paths += ["-o", str(self.place / "compare.html")]
        with self.assertRaises(squeal.ResultsError) as error:
            compare.main(paths)
        return str(error.exception)

    def test_what_cannot_be_compared_is_refused_by_name(self):
        points = {0.4: [(HZ * 100 + 1, "unstable", ALONG)]}
        good = self.write("good", points)
        page = self.place / "compare.html"
        page.write_text(PAGE)
        self.write("stopped", points, complete=False)
        self.write("elsewhere", {0.5: points[0.4]})
        for name in ("cut", "lost", "torn"):
            shutil.copytree(good, self.place / name)
        (self.place / "cut/eigenvalues.csv").write_text("friction,speed\n0,1\n")
        (self.place / "lost/results.h5").unlink()
        with open(self.place / "torn/results.h5", "r+b") as file:
            file.truncate(1000)
        for name, text in (
            ("stopped", "stopped holds no complete results: its run was interrupted"),
            ("cut", "cut/eigenvalues.csv: there is no column pressure"),
            ("lost", "lost/results.h5 is missing"),
            ("torn", "torn/results.h5 is damaged"),
            ("nowhere", "nowhere holds no complete results: there is no summary.json"),
            ("elsewhere", "elsewhere have no common point of the sweep"),
            ("good/../good", "good is named twice"),
        ):
            self.assertIn(text, self.refused("good", name))
            self.assertEqual(page.read_text(), PAGE)
        self.assertIn("at least two folders", self.refused("good"))
        done = subprocess.run(
            [COMMAND, "good", "cut"], capture_output=True, text=True, cwd=self.place
        )
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(done.stderr, r"^squeal-compare: cut/eigenvalues.csv: there is no .*\n$")

    def test_only_an_earlier_page_is_replaced(self):
        points = {0.4: [(HZ * 100 + 1, "unstable")]}
        for name in ("one", "other"):
            self.write(name, points)
        mine = self.place / "mine.html"
        for text in ("mine", "\udcff"):
            mine.write_bytes(text.encode(errors="surrogateescape"))
            self.assertIn("name another file with -o", self.refused("one", "other", "-o", mine))
            self.assertEqual(mine.read_bytes(), text.encode(errors="surrogateescape"))
        self.assertIn("is a folder", self.refused("one", "other", "-o", "one"))
        self.assertIn("cannot write", self.refused("one", "other", "-o", "none/page.html"))
        mine.write_text(PAGE)
        done = subprocess.run(
            [COMMAND, "one", "other", "-o", mine],
            capture_output=True,
            text=True,
            cwd=self.place,
            check=True,
        )
        self.assertIn("compare: 1 of 1 points of the sweeps are common", done.stdout)
        self.assertTrue(done.stdout.endswith(f"{mine}\n"))
        self.assertIn("2 variants of bar", mine.read_text())
        self.assertEqual(
            sorted(path.name for path in self.place.iterdir()), ["mine.html", "one", "other"]
        )


if __name__ == "__main__":
    unittest.main(verbosity=2)
