#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The page of the report, its diagrams and its table of eigenvalues: test_report.py PROGRAM
RESULTS."""
import json
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path
from unittest import mock

import h5py
import numpy as np
import pandas as pd
from PIL import Image
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

from pages import Pages, repository
import report_picture
import squeal
from squeal import blobs as packing
from squeal import report
from squeal.keys import PARAMETERS


def shown(value, digits):
    """A number as the report shows it."""
    return f"{float(f'{value:.{digits}g}'):.15g}" if abs(value) >= 1e-6 or value == 0 else None


class Report(Pages):
    OPEN_PAGES = {
        "test_asks_the_network_for_nothing_and_logs_no_error",
        "test_judged_list_and_proofs",
        "test_names_are_text_not_markup",
        "test_picture",
        "test_without_the_libraries_the_pictures_stand_in",
    }

    def test_asks_the_network_for_nothing_and_logs_no_error(self):
        self.driver.get_log("performance")  # of other tests
        self.open_page(self.folder / "report.html")
        events = [
            json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")
        ]
        asked = [
            event["params"]["request"]["url"]
            for event in events
            if event["method"] == "Network.requestWillBeSent"
        ]
        self.assertTrue(asked)  # the page itself
        self.assertEqual(
            [url for url in asked if not url.startswith(("file:", "data:", "blob:"))], []
        )
        self.assertEqual(
            {url for url in asked if url.startswith("file:")},
            {(self.folder / "report.html").as_uri()},
        )
        self.assertEqual(self.driver.get_log("browser"), [])
        self.assertNotRegex(
            (self.folder / "report.html").read_text(),
            r'<(script|link|img)[^>]*(src|href)="(?!data:)',
        )

    def test_judged_list_and_proofs(self):
        other = Path(self.temporary.name) / "judged"
        shutil.copytree(self.folder, other, ignore=shutil.ignore_patterns("vtk", "report.html"))
        run = squeal.open(other)
        turn = 2 * np.pi
        head = (
            "entry growth_rate_1_per_s angular_frequency_rad_per_s verdict"
            " proved_growth_rate_1_per_s proved_angular_frequency_rad_per_s radius_rad_per_s"
            " distance_rad_per_s"
        ).split()
        nothing = float("nan")
        judged = pd.DataFrame(
            [
                [1, -2.0, 1000 * turn, "right", -2.0, 1000 * turn, 1e-3, 1e-5],
                [2, 5.0, 2000 * turn, "inexact", 8.0, 2000 * turn, 1e-3, 3.0],
                [nothing, nothing, nothing, "missing", 4.0, 1500 * turn, 1e-3, nothing],
            ],
            columns=head,
        )
        points = run.stability_map[list(PARAMETERS)].head(2).reset_index(drop=True)
        proof = points.assign(
            complete=[1, 0],
            count_proved=[1, 0],
            eigenvalues=[23.5, 0.0],
            top_hz=[7000.0, 7001.0],
            left_1_per_s=[850.0, nothing],
            ratio=[0.25, 1.5],
            reason=["", "ratio 1.5 <b>"],
        )
        tables = {**run._tables, "referee": judged, "proof": proof}
        with mock.patch.object(run, "_tables", tables):
            (other / "report.html").write_text(report.build(run))
        self.open_page(other / "report.html")
        self.assertTrue(self.element("judged").is_displayed())
        table = self.element("judgedtable")
        lines = [
            [cell.text for cell in row.find_elements(By.TAG_NAME, "td")]
            for row in table.find_elements(By.CSS_SELECTOR, "tbody tr")
        ]
        # The faults, the worst kind first; growth rates and frequencies with the proved ones.
        self.assertEqual(lines[0][:6], ["missing", "", "", "", "1500", "4"])
        self.assertEqual(lines[1][:6], ["inexact", "2", "2000", "5", "2000", "8"])
        self.assertEqual(len(lines), 2)
        self.assertEqual(self.element("judgedcount").text, "2 of 3 rows")
        sets = self.run_script(
            "return judged.chart.data.datasets.map((s) => [s.label, s.data[0].x, s.data[0].y])"
        )
        self.assertEqual([name for name, *_ in sets], ["missing", "inexact", "right"])
        np.testing.assert_allclose(
            [place for _, *place in sets], [[1500, 4], [2000, 5], [1000, -2]]
        )
        text = self.run_script("return element('more').textContent")
        for words in ("complete", "23.5", "-850", "not proved", "ratio 1.5 <b>"):
            self.assertIn(words, text)
        grounds = self.run_script("return element('certificate').textContent")
        self.assertIn("The list is proved to be complete at 1 of 2 points", grounds)
        self.assertIn("(largest ratio 0.25; round-off is not bounded).", grounds)
        self.assertEqual(self.driver.get_log("browser"), [])

    def test_a_large_file_leaves_out_shapes_and_fields(self):
        def blobs(text):
            return {
                name: len(content)
                for name, content in re.findall(r'id="blob-(\w+)">([^<]*)<', text)
            }

        whole = blobs((self.folder / "report.html").read_text())
        shapes = [name for name in whole if re.fullmatch(r"shape\d+", name)]
        most = sum(whole.values()) // 2
        with mock.patch.object(packing, "MOST_BYTES", most):
            text = report.build(squeal.open(self.folder))
        less = blobs(text)
        there = [name for name in less if re.fullmatch(r"shape\d+", name)]
        self.assertLessEqual(sum(less.values()), most)
        self.assertEqual(there, shapes[: len(there)])  # the fastest growing ones
        self.assertGreater(len(there), 0)
        self.assertIn(
            f"The shapes of {len(shapes) - len(there)} slower growing modes were left out", text
        )
        with mock.patch.object(packing, "MOST_BYTES", 4 * whole["steady"] - 4):
            text = report.build(squeal.open(self.folder))
        self.assertLess(blobs(text)["steady"], whole["steady"])
        self.assertIn("Contact fields are shown at 2 of the 4 points of the sweep", text)

    def test_hovering_tells_the_row_of_the_table(self):
        for friction, mode in [*self.kept()[:2], (0.2, 1)]:
            row = self.row_of(friction, mode)
            self.move_to("frequency", row).perform()
            WebDriverWait(self.driver, 5).until(lambda _: self.element("hover").is_displayed())
            text, values = self.element("hover").text, self.rows[row]
            self.assertEqual(text.split("\n")[0], f"mode {mode} at friction {friction:g}")
            self.assertIn(f"\n{shown(float(values['frequency_hz']), 8)} Hz\n", text)
            growth = float(re.search(r"growth (\S+) 1/s", text)[1])
            self.assertAlmostEqual(
                growth, float(values["growth_rate_1_per_s"]), delta=1e-5 * abs(growth)
            )
            damping = float(re.search(r"damping (\S+) %", text)[1])
            self.assertAlmostEqual(
                damping, 100 * float(values["damping_ratio"]), delta=1e-3 * abs(damping)
            )
            error = float(re.search(r"error \|δs\|/\|s\| (\S+)", text)[1])
            self.assertAlmostEqual(error, float(values["error_estimate"]), delta=0.06 * error)
            self.assertTrue(text.endswith("\n" + values["verdict"]))

    def test_a_click_shows_another_mode(self):
        first, second = self.kept()[0], next(
            one for one in self.kept() if one[0] != self.kept()[0][0]
        )
        self.select(*first)
        before = self.element("canvas").get_attribute("data-mode"), self.turn_to(0, 0.1)
        self.move_to("frequency", self.row_of(*second)).click().perform()
        WebDriverWait(self.driver, 5).until(
            lambda _: self.element("canvas").get_attribute("data-mode") != before[0]
        )
        self.assertIn(f"mode {second[1]} at friction {second[0]:g} ", self.element("chosen").text)
        self.assertNotEqual(self.turn_to(0, 0.1), before[1])
        marked = self.driver.find_elements(By.CSS_SELECTOR, "#table tr.selected")
        self.assertEqual(
            [row.get_attribute("data-row") for row in marked], [str(self.row_of(*second))]
        )

    def test_the_keyboard_walks_among_modes(self):
        self.select(0.2, 30)
        self.element("sweep").send_keys(Keys.ARROW_UP)
        self.assertIn("mode 31 at friction 0.2 ", self.element("chosen").text)
        self.element("sweep").send_keys(Keys.ARROW_RIGHT)
        s = {
            float(row["friction"]): complex(
                float(row["growth_rate_1_per_s"]), float(row["angular_frequency_rad_per_s"])
            )
            for row in self.rows
            if row["mode"] == "31"
        }
        nearest = min(
            (row for row in self.rows if float(row["friction"]) == 0.4),
            key=lambda row: abs(
                complex(
                    float(row["growth_rate_1_per_s"]), float(row["angular_frequency_rad_per_s"])
                )
                - s[0.2]
            ),
        )
        self.assertIn(f"mode {nearest['mode']} at friction 0.4 ", self.element("chosen").text)
        row = self.driver.find_element(By.CSS_SELECTOR, "#table tbody tr")
        row.send_keys(Keys.ENTER)
        self.assertEqual(
            self.run_script("return state.selected"), int(row.get_attribute("data-row"))
        )

    def test_the_table_is_sorted_and_filtered(self):
        everything = len(self.rows)
        self.assertEqual(
            self.run_script("state.filter = ''; listRows(); return listed.length"), everything
        )
        self.assertEqual(
            self.run_script("state.filter = 'unstable'; listRows(); return listed.length"),
            sum(row["verdict"] in ("unstable", "undecided") for row in self.rows),
        )
        growth = self.run_script("return listed.map((i) => eigen.growth_rate_1_per_s[i])")
        self.assertEqual(growth, sorted(growth, reverse=True))
        self.driver.find_element(
            By.XPATH, "//table[@id='table']//th/button[starts-with(., 'frequency')]"
        ).click()
        frequency = self.run_script("return listed.map((i) => eigen.frequency_hz[i])")
        self.assertEqual(frequency, sorted(frequency, reverse=True))
        self.element("find").send_keys("0.4")
        self.assertEqual(set(self.run_script("return listed.map((i) => eigen.friction[i])")), {0.4})
        self.element("find").send_keys(Keys.BACKSPACE * 3)

    def test_fits_a_screen(self):
        """1280 × 800: no scrolling sideways; diagrams and shape are seen at once, in both
        schemes."""
        width, height = self.run_script(
            "return [document.documentElement.scrollWidth, innerHeight]"
        )
        self.assertLessEqual(width, self.run_script("return innerWidth"))
        for name in ("frequency", "view"):
            box = self.element(name).rect
            self.assertLess(box["y"] + box["height"], height + 20, name)
        light = self.run_script("return getComputedStyle(document.body).backgroundColor")
        self.element("scheme").click()
        self.assertNotEqual(
            self.run_script("return getComputedStyle(document.body).backgroundColor"), light
        )
        self.element("scheme").click()

    def test_names_are_text_not_markup(self):
        """Whatever a user may name: the folder, bodies, interfaces, options, what they are set to;
        and texts of others."""
        bad = "<img id=bad src=x onerror=window.bad=1>"
        copy = Path(self.temporary.name) / "<b id=bad>{{data}}<!--"
        shutil.copytree(self.folder, copy, ignore=shutil.ignore_patterns("vtk", "report.html"))
        summary = json.loads((copy / "summary.json").read_text())
        summary["options"].update({"mesh_file": "</script><b id=bad>", "mesh_" + bad: bad})
        summary["version"] = bad
        summary["stages"][bad] = {"wall_s": 1.0}
        for point in summary["frictions"]:
            point["steady"]["interfaces"] = {bad: point["steady"]["interfaces"]["pad"]}
        summary["active_sets"][0]["followed"][0]["statement"] = bad
        (copy / "summary.json").write_text(json.dumps(summary))
        work = (copy / "friction_work.csv").read_text()
        (copy / "friction_work.csv").write_text(work.replace(",pad,", f",{bad},"))
        with h5py.File(copy / "results.h5", "r+") as file:
            file["mesh"].attrs["bodies"] = np.bytes_(
                file["mesh"].attrs["bodies"].replace(b"disc", bad.encode())
            )
        licence = Path(self.temporary.name) / "licence"
        licence.write_text(bad)
        with mock.patch.dict(
            report.SCRIPTS, {"Chart.js": (report.SCRIPTS["Chart.js"][0], licence)}
        ):
            (copy / "page.html").write_text(report.build(squeal.open(copy)))
        self.open_page(copy / "page.html")
        self.assertEqual(self.driver.find_elements(By.ID, "bad"), [])
        self.assertIsNone(self.run_script("return window.bad"))
        self.assertTrue(self.driver.title.startswith(copy.name))
        self.assertEqual(
            self.run_script("return data.options.mesh_file"), summary["options"]["mesh_file"]
        )
        said = {
            place: self.run_script("return element(arguments[0]).textContent", place)
            for place in ("certificate", "bodies", "more", "recipe")
        }
        for place, text in {
            **said,
            "licences": self.run_script("return document.querySelector('footer').textContent"),
        }.items():
            self.assertIn(bad, text, place)
        # Friction work; forces, a stage
        self.assertEqual(
            said["more"].count(bad) - work.count(",pad,"), len(summary["frictions"]) + 1
        )
        self.assertEqual(said["recipe"].count(bad), 3)

    def test_picture(self):
        """scripts/dev/report_picture.py shows the mode; a report that shows none is refused, and no
        picture written."""

        class Shared:
            """The browser of these tests, which stays open, in the place of one of the script."""

            def __init__(self, driver):
                self.driver = driver

            def __getattr__(self, name):
                return getattr(self.driver, name)

            def quit(self):
                self.driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
                self.driver.execute_cdp_cmd("Emulation.setScrollbarsHidden", {"hidden": False})

        def place(name, text):
            folder = Path(self.temporary.name) / name
            folder.mkdir()
            if text:
                (folder / "report.html").write_text(text)
            return folder, folder / "out.png"

        text = (self.folder / "report.html").read_text()
        folder, picture = place("whole", text)
        done = subprocess.run(
            [repository / "scripts/dev/report_picture.py", folder, picture],
            capture_output=True,
            text=True,
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with Image.open(picture) as image:
            self.assertEqual((image.format, image.size), ("PNG", (1280, 657)))
            view = image.convert("RGB").crop((700, 220, 1100, 580))  # left of the scale
        colours = view.getcolors(1 << 24)
        self.assertGreater(len(colours), 40)
        self.assertLess(max(count for count, _ in colours) / (view.width * view.height), 0.8)
        nothing = text.replace("view.renderer.render(view.scene, view.camera);", "")
        self.assertNotEqual(nothing, text)
        with mock.patch.dict(report.SCRIPTS, {"Chart.js": ("/nowhere.js", None)}):
            bare = report.build(squeal.open(self.folder))
        type(self).page = None
        for name, text, message in (
            ("empty", nothing, "is empty: it has 1 colours"),
            ("bare", bare, "shows no mode"),
            ("none", "", "there is no "),
        ):
            folder, picture = place(name, text)
            words = ["report_picture.py", str(folder), str(picture)]
            with mock.patch.object(sys, "argv", words), mock.patch.object(
                report_picture, "browser", lambda: Shared(self.driver)
            ), self.assertRaises(SystemExit) as ended:
                report_picture.main()
            said = str(ended.exception.code)  # a text: exit code 1
            self.assertEqual(len(said.splitlines()), 1, said)
            self.assertIn(message, said)
            self.assertFalse(picture.exists())

    def test_without_the_libraries_the_pictures_stand_in(self):
        run = squeal.open(self.folder)
        picture, other = self.folder / 'stability_"><b id=bad>.png', self.folder / "mode.png"
        for path, size in ((picture, (30, 20)), (other, (7, 5))):
            self.addCleanup(path.unlink)
            Image.new("RGB", size).save(path)
        for name in report.SCRIPTS:
            with self.subTest(name), mock.patch.dict(report.SCRIPTS, {name: ("/nowhere.js", None)}):
                text = report.build(run)
                self.assertIn("libjs-three, libjs-chart.js", text)
                self.assertIn(report.verdict(run), text)
                self.assertNotIn("blob-shape", text)
                self.assertNotIn("new THREE", text)  # not one library without the other
                self.assertNotIn("new Chart", text)
        page = Path(self.temporary.name) / "bare.html"
        page.write_text(text)
        self.driver.get_log("browser")
        type(self).page = page
        self.driver.get(page.as_uri())
        self.assertEqual(
            self.run_script(
                "return [...document.images].map((image) => [image.naturalWidth,"
                " image.naturalHeight])"
            ),
            [[30, 20], [7, 5]],
        )
        self.assertEqual(self.driver.find_elements(By.ID, "bad"), [])
        self.assertIn(report.verdict(run), self.driver.find_element(By.TAG_NAME, "body").text)
        self.assertEqual(self.driver.get_log("browser"), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
