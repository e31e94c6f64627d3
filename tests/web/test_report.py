#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The report of a run, made by scripts/squeal-report and opened in Chromium: test_report.py
PROGRAM."""
import csv
import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import h5py
import numpy as np
from PIL import Image
from scipy.spatial.transform import Rotation
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / folder) for folder in ("python", "scripts/dev")]
sys.dont_write_bytecode = True
import report_picture
import squeal
from report_picture import browser
from squeal import report
from squeal.skin import Skin

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")
COARSE = "n_pad_theta=8,n_free_theta=12,n_mount=2,n_plate=1,n_inside=1,n_pad_r=4,n_hat=2,n_h_ring=2"


# These open pages by themselves, whatever page is open.
OPEN_PAGES = {
    "test_asks_the_network_for_nothing_and_logs_no_error",
    "test_names_are_text_not_markup",
    "test_picture",
    "test_webgl_that_is_lost",
    "test_without_the_libraries_the_pictures_stand_in",
    "test_without_webgl_diagrams_and_tables_live",
}


def shown(value, digits):
    """A number as the report shows it."""
    return f"{float(f'{value:.{digits}g}'):.15g}" if abs(value) >= 1e-6 or value == 0 else None


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.folder = Path(cls.temporary.name) / "coarse"
        subprocess.run(
            [
                PROGRAM,
                "-options_file",
                repository / "options/disc_brake.yaml",
                "-modes_count",
                "60",
                "-mesh_set",
                COARSE,
                "-flutter_friction",
                "0,0.2,0.4,0.6",
                "-report_dir",
                cls.folder,
                "-quiet",
            ],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        subprocess.run(
            [repository / "scripts/squeal-report", cls.folder],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        with open(cls.folder / "eigenvalues.csv", newline="") as file:
            cls.rows = list(csv.DictReader(file))
        cls.driver = browser(browser="ALL", performance="ALL")
        cls.addClassCleanup(cls.driver.quit)
        cls.page = None

    def setUp(self):
        if self.page != self.folder / "report.html" and self._testMethodName not in OPEN_PAGES:
            self.open_page(self.folder / "report.html")

    @classmethod
    def open_page(cls, path):
        cls.page = path
        cls.driver.get(path.as_uri())
        WebDriverWait(cls.driver, 60).until(
            lambda driver: cls.run_script("return document.documentElement.dataset.ready")
        )

    @classmethod
    def run_script(cls, text, *arguments):
        return cls.driver.execute_script(text, *arguments)

    def element(self, name):
        return self.driver.find_element(By.ID, name)

    def select(self, friction, mode):
        """Selects a mode and waits for its shape."""
        self.driver.execute_async_script(
            (
                "const [friction, mode, done] = arguments; select(rows.find((i) =>"
                " eigen.friction[i] === friction && eigen.mode[i] ==="
                " mode));showShape().then(done);"
            ),
            friction,
            mode,
        )

    def turn_to(self, degrees, amplitude):
        self.run_script(
            (
                "play(false); element('amplitude').value = arguments[1]; view.phase = arguments[0]"
                " * Math.PI / 180; move();"
            ),
            degrees,
            amplitude,
        )
        return self.run_script("return element('canvas').toDataURL()")

    def place_of(self, diagram, row):
        """Where the point of a row of the table of eigenvalues lies on the screen, from the middle
        of the diagram."""
        return self.run_script(
            (
                "const chart = charts[arguments[0]].chart; for (const set of [1, 2, 3]) { const k ="
                " chart.data.datasets[set].data.findIndex((p) => p.row === arguments[1]); if (k >="
                " 0) { const p = chart.getDatasetMeta(set).data[k]; return [p.x - chart.width / 2,"
                " p.y - chart.height / 2]; } }"
            ),
            diagram,
            row,
        )

    def move_to(self, diagram, row):
        x, y = self.place_of(diagram, row)
        return ActionChains(self.driver).move_to_element_with_offset(
            self.element(diagram), round(x), round(y)
        )

    def row_of(self, friction, mode):
        return next(
            i
            for i, row in enumerate(self.rows)
            if float(row["friction"]) == friction and int(row["mode"]) == mode
        )

    def kept(self):
        return [(shape["at"][0], shape["mode"]) for shape in self.run_script("return data.shapes")]

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

    def test_the_canvas_shows_the_mode_and_two_phases_differ(self):
        self.select(*self.kept()[0])
        still = [self.turn_to(degrees, 0) for degrees in (0, 90)]
        self.assertEqual(*still)
        moved = [self.turn_to(degrees, 0.1) for degrees in (0, 90, 180)]
        self.assertEqual(len({*still, *moved}), 4)
        colours = self.run_script(
            "const copy = document.createElement('canvas'); [copy.width, copy.height] = [300, 200];"
            " const c = copy.getContext('2d');c.drawImage(element('canvas'), 0, 0, 300, 200); const"
            " all = new Set(), p = c.getImageData(0, 0, 300, 200).data;for (let i = 0; i <"
            " p.length; i += 4) all.add(p[i] * 65536 + p[i + 1] * 256 + p[i + 2]); return all.size;"
        )
        self.assertGreater(colours, 100)  # an empty canvas has one

    def check_motion(self, skin, modes):
        """Re((a + ib) exp(iφ)) of the file, to the 1/127 of the quantised shapes and the 1/65534 of
        places."""
        with h5py.File(self.folder / "results.h5") as file:
            places = file["mesh/coordinates"][()]
            for friction, mode in modes:
                self.select(friction, mode)
                group = file[f"flutter/friction_{friction:g}"]
                shape = (
                    group[f"mode_{mode:03d}_real"][()]
                    + 1j * group[f"mode_{mode:03d}_imaginary"][()]
                )
                largest = max(np.abs(shape.real).max(), np.abs(shape.imag).max())
                size = (places[skin.nodes].max(axis=0) - places[skin.nodes].min(axis=0)).max()
                middle = (places[skin.nodes].max(axis=0) + places[skin.nodes].min(axis=0)) / 2
                for degrees in (0, 60, 200):
                    self.turn_to(degrees, 0.1)
                    wanted = (places - middle) / size + 0.1 * (
                        shape * np.exp(1j * np.radians(degrees))
                    ).real / largest
                    found = np.array(self.run_script("return Array.from(view.places)")).reshape(
                        -1, 3
                    )
                    self.assertLess(np.abs(found - wanted[skin.nodes]).max(), 0.1 / 127 + 1e-4)

    def test_nodes_move_as_results_h5_says(self):
        self.check_motion(Skin(squeal.open(self.folder).mesh), self.kept()[:3])

    def test_a_large_skin_is_drawn_coarser(self):
        """On some of its nodes, which move as all do; no place of it, on flat faces either, is far
        from one of them."""
        run = squeal.open(self.folder)
        whole, places = Skin(run.mesh), run.mesh.coordinates
        self.assertEqual((whole.whole, whole.detail), (len(whole.triangles), 0))
        page = Path(self.temporary.name) / "coarser.html"
        with mock.patch("squeal.skin.MOST_TRIANGLES", 1000):
            coarse = Skin(run.mesh)
            page.write_text(report.build(run))
        self.assertLessEqual(len(coarse.triangles), 1000)
        self.assertGreater(len(coarse.triangles), 300)
        self.assertEqual(
            [body["name"] for body in coarse.bodies], [body["name"] for body in whole.bodies]
        )
        for part, body in zip(coarse.bodies, whole.bodies):
            mine, all_of_it = (
                coarse.nodes[slice(*part["nodes"])],
                whole.nodes[slice(*body["nodes"])],
            )
            self.assertLessEqual(set(mine), set(all_of_it))
            far = (
                np.linalg.norm(places[all_of_it][:, None] - places[mine][None], axis=2)
                .min(axis=1)
                .max()
            )
            self.assertLessEqual(far, 2 * np.sqrt(3) * coarse.detail)
            for cells, kind in ((coarse.triangles, "triangles"), (coarse.lines, "lines")):
                used = cells[slice(*part[kind])]
                self.assertTrue(((used >= part["nodes"][0]) & (used < part["nodes"][1])).all())

        def longest(skin):
            corners = places[skin.nodes[skin.triangles]]
            return np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max()

        # A triangle joins the cubes in which the corners of one of the whole skin lie.
        self.assertLessEqual(longest(coarse), longest(whole) + 2 * np.sqrt(3) * coarse.detail)
        self.driver.get_log("browser")
        self.open_page(page)
        self.check_motion(coarse, self.kept()[:1])
        self.assertGreater(self.run_script("return new Set(view.colours).size"), 20)
        self.assertEqual(self.driver.get_log("browser"), [])
        self.assertIn(
            (
                f"The surface has {whole.whole} triangles and is drawn with"
                f" {len(coarse.triangles)}, on {len(coarse.nodes)} of its nodes"
            ),
            self.element("more").text,
        )

    def test_bodies_below_the_detail_are_named(self):
        """A cube of one cell beside a plate of 800 is smaller than what is drawn of the plate's
        surface."""
        run = squeal.open(self.folder)
        places, blocks, bodies = [], [], []
        for body, (count, size, at) in enumerate(
            (((20, 20, 2), (1, 1, 0.1), 0), ((1, 1, 1), (1e-3,) * 3, 2.001))
        ):
            corners = np.indices([n + 1 for n in count]).reshape(3, -1).T
            first = np.ravel_multi_index(np.indices(count).reshape(3, -1), [n + 1 for n in count])
            steps = np.ravel_multi_index(
                np.array(
                    [
                        (0, 0, 0),
                        (1, 0, 0),
                        (1, 1, 0),
                        (0, 1, 0),
                        (0, 0, 1),
                        (1, 0, 1),
                        (1, 1, 1),
                        (0, 1, 1),
                    ]
                ).T,
                [n + 1 for n in count],
            )
            blocks.append(sum(map(len, places)) + first[:, None] + steps)
            places.append(at + corners * size / count)
            bodies.append(np.full((len(first), 1), body))
        cells = {5: {"nodes": np.concatenate(blocks), "body": np.concatenate(bodies)}}
        mesh = squeal.results.Mesh(np.concatenate(places), cells, ["plate", "pin"])
        self.assertEqual((Skin(mesh).unseen, Skin(mesh).whole), ([], 2 * (2 * 400 + 4 * 40) + 12))
        turned = squeal.results.Mesh(
            mesh.coordinates @ Rotation.from_euler("xyz", [40, 35, 20], degrees=True).as_matrix(),
            cells,
            mesh.bodies,
        )
        # What is oblique to the cubes of space goes through more of them
        for each in (
            mesh,
            turned,
        ):
            with mock.patch("squeal.skin.MOST_TRIANGLES", 200):
                skin = Skin(each)
            self.assertEqual(
                ([body["name"] for body in skin.bodies], skin.unseen), (["plate"], ["pin"])
            )
            self.assertLessEqual(len(skin.triangles), 200)
            self.assertGreater(len(skin.triangles), 60)
        whole = Skin(run.mesh)
        whole.unseen = ["pin", "shim"]
        with mock.patch.object(report, "Skin", return_value=whole):
            self.assertIn("Bodies that are smaller are not drawn: pin, shim.", report.build(run))
        self.assertNotIn("Bodies that are smaller", report.build(run))

    def test_a_large_file_leaves_out_shapes_and_fields(self):
        def blobs(text):
            return {
                name: len(content)
                for name, content in re.findall(r'id="blob-(\w+)">([^<]*)<', text)
            }

        whole = blobs((self.folder / "report.html").read_text())
        shapes = [name for name in whole if re.fullmatch(r"shape\d+", name)]
        most = sum(whole.values()) // 2
        with mock.patch.object(report, "MOST_BYTES", most):
            text = report.build(squeal.open(self.folder))
        less = blobs(text)
        there = [name for name in less if re.fullmatch(r"shape\d+", name)]
        self.assertLessEqual(sum(less.values()), most)
        self.assertEqual(there, shapes[: len(there)])  # the fastest growing ones
        self.assertGreater(len(there), 0)
        self.assertIn(
            f"The shapes of {len(shapes) - len(there)} slower growing modes were left out", text
        )
        with mock.patch.object(report, "MOST_BYTES", 4 * whole["steady"] - 4):
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

    def test_contact_fields_are_those_of_results_h5(self):
        with h5py.File(self.folder / "results.h5") as file:
            pressure = file["steady/friction_0.4/contact_pressure_gap"][:, 0]
        name = self.run_script(
            "element('point').value = 2; element('field').value = 'pressure'; colour(); return"
            " element('pointname').textContent"
        )
        self.assertEqual(name, "friction 0.4")
        values = self.run_script(
            "return [Array.from(view.touching), Array.from(fieldValues('pressure'))]"
        )
        skin = Skin(squeal.open(self.folder).mesh)
        np.testing.assert_allclose(values[1], pressure[skin.nodes[values[0]]], rtol=1e-6)
        self.assertEqual(len(set(skin.nodes[values[0]])), np.count_nonzero(pressure))
        self.run_script("element('field').value = 'amplitude'; colour();")

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

    def check_alive(self, driver, why):
        """Without shapes the report says why; diagrams and tables are complete and answer to clicks
        and keys."""

        def script(text, *arguments):
            return driver.execute_script(text, *arguments)

        note = driver.find_element(By.ID, "noview")
        self.assertTrue(note.is_displayed())
        self.assertIn(f"The shapes of the modes are not drawn: {why}", note.text)
        self.assertEqual(
            driver.find_elements(By.ID, "view") + driver.find_elements(By.ID, "play"), []
        )
        drawn = script(
            "return Object.values(charts).map((one) => one.chart.data.datasets.slice(1,"
            " 4).reduce((sum, set) => sum + set.data.length, 0))"
        )
        self.assertEqual(drawn, [len(self.rows)] * 3)
        self.assertGreater(
            script(
                "const c = element('frequency').getContext('2d'), p = c.getImageData(0, 0,"
                " c.canvas.width, c.canvas.height).data;const all = new Set(); for (let i = 0; i <"
                " p.length; i += 4) all.add(p[i] * 65536 + p[i + 1] * 256 + p[i + 2]); return"
                " all.size;"
            ),
            10,
        )
        self.assertEqual(
            script("state.filter = ''; listRows(); return element('table').tBodies[0].rows.length"),
            len(self.rows),
        )
        self.assertIn(
            "Points of the sweep",
            [one.text for one in driver.find_elements(By.CSS_SELECTOR, "#more summary")],
        )
        before = driver.find_element(By.ID, "chosen").text
        driver.find_element(By.ID, "sweep").send_keys(Keys.ARROW_DOWN)
        self.assertNotEqual(driver.find_element(By.ID, "chosen").text, before)
        driver.find_elements(By.CSS_SELECTOR, "#table tbody tr")[7].click()
        self.assertEqual(script("return state.selected"), script("return listed[7]"))
        driver.find_element(By.ID, "scheme").click()
        self.assertEqual(
            script("return charts.frequency.chart.options.scales.x.title.color"),
            script("return css('--ink')"),
        )
        self.assertEqual(
            [entry for entry in driver.get_log("browser") if entry["level"] == "SEVERE"], []
        )

    def test_without_webgl_diagrams_and_tables_live(self):
        for webgl, hook, why in (
            (False, "", "this browser offers no WebGL"),
            (True, "delete window.DecompressionStream", "this browser is too old to unpack them"),
        ):
            with self.subTest(why):
                driver = browser(webgl, browser="ALL")
                try:
                    driver.execute_cdp_cmd(
                        "Page.addScriptToEvaluateOnNewDocument", {"source": hook}
                    )
                    driver.get((self.folder / "report.html").as_uri())
                    WebDriverWait(driver, 60).until(
                        lambda driver: driver.execute_script(
                            "return document.documentElement.dataset.ready"
                        )
                    )
                    self.check_alive(driver, why)
                finally:
                    driver.quit()

    def test_webgl_that_is_lost(self):
        """A driver may be restarted, or the browser may have too many views."""
        self.open_page(self.folder / "report.html")
        self.driver.get_log("browser")
        type(self).page = None  # without its view
        self.run_script("view.renderer.forceContextLoss()")
        WebDriverWait(self.driver, 10).until(lambda driver: driver.find_elements(By.ID, "noview"))
        self.check_alive(self.driver, "the browser has taken WebGL away from this page")

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
