#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Rankings of variants and the page that compares them, on small results written here."""
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / folder) for folder in ("python", "tests/support/run")]
sys.dont_write_bytecode = True
import squeal
from squeal import compare, variants
from written_results import ALONG, HZ, OnWrittenResults

COMMAND = repository / "scripts/squeal-compare"
PAGE = f"<html>{compare.MARK}"  # an earlier page


class Variants(OnWrittenResults):
    def read(self, *folders):
        return variants.read_variants(folders)

    def ranks(self, *folders):
        table = variants.rankings(self.read(*folders))
        return {
            criterion: dict(zip(rows["variant"], rows["rank"]))
            for criterion, rows in table.groupby("criterion")
        }

    def refused(self, *words):
        """Returns why the command refuses folders and files."""
        paths = [word if word == "-o" else str(self.place / word) for word in words]
        if "-o" not in words:
            paths += ["-o", str(self.place / "compare.html")]
        with self.assertRaises(squeal.ResultsError) as error:
            compare.main(paths)
        return str(error.exception)

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
