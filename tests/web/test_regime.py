#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The motion after flutter in the report, opened in Chromium: test_regime.py PROGRAM RESULTS, with
the results of after_flutter.py."""
import json
import shutil
import unittest
from pathlib import Path
from unittest import mock

from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import Select

from pages import Pages, rows
import after_flutter
import squeal
from squeal import regime, report
from changed_tables import reshape


class AfterFlutter(Pages):
    RUN = after_flutter.RUN

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.run_row = rows(cls.folder / "regime.csv")[0]

    def drawn(self, name):
        """The first line, or the points, of a diagram as Chart.js has them."""
        return self.driver.execute_script(
            "return regime.charts[arguments[0]].data.datasets[0].data", name
        )

    def test_the_sentence_is_that_of_the_table(self):
        said, row = self.element("regimesentence").text, self.run_row
        self.assertTrue(
            said.startswith(
                f"At friction 0.4 the motion from mode {row['start']} becomes {row['class']}, not"
                " settled"
            ),
            said,
        )
        self.assertIn(
            (
                f"carrier {float(row['carrier_hz']):.6g} Hz (flutter"
                f" {float(row['flutter_frequency_hz']):.6g} Hz)"
            ),
            said,
        )
        self.assertIn(
            (
                f"{float(row['sound_power_estimate_w']):.2g} W,"
                f" {float(row['sound_power_level_db']):.0f} dB"
            ),
            said,
        )
        self.assertTrue(self.element("regime").is_displayed())

    def test_diagrams_are_those_of_the_tables(self):
        cycles = rows(self.folder / "regime_cycles.csv")
        self.assertEqual(
            self.drawn("cycles"),
            [
                {"x": 1e3 * float(row["time_s"]), "y": float(row["largest_kinetic_energy_j"])}
                for row in cycles
            ],
        )
        spectrum = [
            row
            for row in rows(self.folder / "regime_spectrum.csv")
            if 0 < float(row["frequency_hz"]) < 4 * float(self.run_row["flutter_frequency_hz"])
        ]
        menu = Select(self.element("regimeline"))
        self.assertEqual(len(menu.options), 3)
        for place, column in enumerate(
            ("velocity_sqrt_kg_m_per_s", "velocity_1_normal_m_per_s", "velocity_2_normal_m_per_s")
        ):
            menu.select_by_index(place)
            self.assertEqual(
                [point["y"] for point in self.drawn("spectrum")],
                [float(row[column]) for row in spectrum],
            )

    def test_periodic_motions_are_those_of_the_table(self):
        motions = rows(self.folder / "periodic.csv")
        self.assertGreater(len(motions), 1)
        self.assertEqual(
            [(point["x"], point["y"]) for point in self.drawn("periodic")],
            [
                (float(row["motion_friction"]), float(row["largest_kinetic_energy_j"]))
                for row in motions
            ],
        )
        filled = self.driver.execute_script(
            "return regime.charts.periodic.data.datasets[0].backgroundColor.map((colour) => colour"
            " !== 'transparent')"
        )
        self.assertEqual(filled, [row["stable"] == "1" for row in motions])
        said = self.element("regimesentence").text
        self.assertIn(
            f"A periodic motion of {float(motions[0]['frequency_hz']):.6g} Hz is unstable", said
        )
        self.assertTrue(self.element("branch").is_displayed())

    def test_nodes_are_coloured_by_what_is_chosen(self):
        nodes = rows(self.folder / "regime_nodes.csv")
        menu = Select(self.element("regimefield"))
        brightest = self.driver.execute_script("return `rgb(${data.colours[31].join(',')})`")
        for place, column in enumerate(
            ("open", "stick", "slip", "mean_pressure_pa", "largest_gap_m", "friction_power_w")
        ):
            menu.select_by_index(place)
            points = self.drawn("nodes")
            self.assertEqual(
                [(point["x"], point["y"]) for point in points],
                [(1e3 * float(row["x_m"]), 1e3 * float(row["y_m"])) for row in nodes],
            )
            values = [float(row[column]) for row in nodes]
            colours = self.driver.execute_script(
                "return regime.charts.nodes.data.datasets[0].backgroundColor"
            )
            self.assertEqual(colours[values.index(max(values))], brightest)
        self.assertIn("W", self.element("nodescale").text)

    def test_diagrams_are_saved_with_their_legends(self):
        for name, legend in (
            ("cycles", "first node separates or sticks"),
            ("spectrum", "flutter mode"),
            ("nodes", "dark: 0, bright:"),
            ("periodic", "periodic motion, filled: stable"),
        ):
            text = self.driver.execute_script("return figures[arguments[0]].svg()", name)
            self.assertIn(legend, text)
            self.assertGreater(text.count("<path"), 20, name)

    def test_works_offline_in_both_schemes(self):
        frames = []
        for dark in (False, True):
            self.driver.execute_script("setScheme(arguments[0])", dark)
            frames.append(
                self.driver.execute_script(
                    "return [css('--ink'), regime.charts.cycles.options.scales.x.title.color]"
                )
            )
        self.assertEqual([ink for ink, _ in frames], [title for _, title in frames])
        self.assertNotEqual(*frames)
        events = [
            json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")
        ]
        asked = [
            event["params"]["request"]["url"]
            for event in events
            if event["method"] == "Network.requestWillBeSent"
        ]
        self.assertEqual(
            [url for url in asked if not url.startswith(("file:", "data:", "blob:"))], []
        )
        self.assertEqual(self.driver.get_log("browser"), [])

    def test_words_are_text_and_nothing_is_shown_where_nothing_was_followed(self):
        self.addCleanup(self.open_page, self.folder / "report.html")
        bad = "<b id=bad>"
        copy = Path(self.temporary.name) / "copy"
        shutil.copytree(self.folder, copy)
        for followed in (True, False):
            if followed:  # a word of a later version; squeal.open() refuses it
                results = squeal.open(copy)
                with mock.patch.object(
                    results,
                    "_tables",
                    {**results._tables, "regime": results.table("regime").assign(**{"class": bad})},
                ):
                    text = report.build(results)
            else:
                (copy / "regime.csv").unlink()
                reshape(copy, without=["regime"])
                text = report.build(squeal.open(copy))
            (copy / "report.html").write_text(text)
            self.open_page(copy / "report.html")
            self.assertEqual(bad in self.element("regimesentence").text, followed)
            self.assertEqual(self.element("regime").is_displayed(), followed)
            self.assertEqual(self.driver.find_elements(By.ID, "bad"), [])
            self.assertEqual(self.driver.get_log("browser"), [])

    def test_a_march_too_short_for_means_has_empty_diagrams(self):
        copy = Path(self.temporary.name) / "short"
        shutil.copytree(self.folder, copy)
        for name in ("spectrum", "nodes", "cycles"):
            path = copy / f"regime_{name}.csv"
            path.write_text(path.read_text().splitlines()[0] + "\n")
        reshape(copy)
        (run,) = regime.diagrams(squeal.open(copy))
        self.assertEqual(
            (run["cycles"], run["nodes"], set(map(len, run["spectrum"].values()))), ([], None, {0})
        )
        (copy / "report.html").write_text(report.build(squeal.open(copy)))
        self.addCleanup(self.open_page, self.folder / "report.html")
        self.open_page(copy / "report.html")
        self.assertTrue(self.element("regime").is_displayed())
        self.assertEqual(self.driver.get_log("browser"), [])

    def test_without_the_libraries_the_sentence_stands(self):
        results = squeal.open(self.folder)
        with mock.patch.dict(report.SCRIPTS, {"Chart.js": ("/nowhere.js", None)}):
            text = report.build(results)
        self.assertIn(regime.sentences(results)[0], text)
        self.assertNotIn("new Chart", text)


if __name__ == "__main__":
    unittest.main(verbosity=2)
