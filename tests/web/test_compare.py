#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Three variants of a coarse disc brake, laid over each other by scripts/squeal-compare and
opened in Chromium: test_compare.py PROGRAM."""
import base64
import io
import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
from PIL import Image
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import Select

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / folder) for folder in ("python", "scripts/dev")]
sys.dont_write_bytecode = True
import squeal
from report_picture import browser
from squeal import compare, variants

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")
COMMAND = repository / "scripts/squeal-compare"
MESH = "n_pad_theta={},n_free_theta=12,n_mount=2,n_plate=1,n_inside=1,n_pad_r=4,n_hat=2,n_h_ring=2"
LOSS = ["-material_lining_loss_factor", "0.1", "-material_lining_loss_frequency", "6000"]
VARIANTS = {
    "base": ["-mesh_set", MESH.format(8), "-flutter_friction", "0.3,0.5"],
    "damped": ["-mesh_set", MESH.format(8), "-flutter_friction", "0.3,0.5", *LOSS],
    "coarser": ["-mesh_set", MESH.format(6), "-flutter_friction", "0.2,0.5"],
}
COMMON = "friction == 0.5"


class Compare(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.place = Path(temporary.name)
        case = ["-options_file", repository / "options/disc_brake.yaml", "-quiet"]
        case += ["-modes_count", "40", "-report_animated", "0"]
        for name, words in VARIANTS.items():
            subprocess.run(
                [PROGRAM, *case, *words, "-report_dir", cls.place / name],
                check=True,
                stdout=subprocess.DEVNULL,
            )
        cls.said = subprocess.run(
            [COMMAND, *VARIANTS], check=True, capture_output=True, text=True, cwd=cls.place
        ).stdout
        cls.runs = {name: squeal.open(cls.place / name) for name in VARIANTS}
        cls.driver = browser(browser="ALL", performance="ALL")
        cls.addClassCleanup(cls.driver.quit)

    def setUp(self):
        self.open_page("compare.html")

    def open_page(self, name):
        self.driver.get_log("performance")
        self.driver.get((self.place / name).as_uri())
        self.assertEqual(self.run_script("return document.documentElement.dataset.ready"), "yes")

    def run_script(self, text, *arguments):
        return self.driver.execute_script(text, *arguments)

    def element(self, name):
        return self.driver.find_element(By.ID, name)

    def cells(self, selector):
        """The texts of the rows of the body of a table."""
        return self.run_script(
            "return [...document.querySelector(arguments[0]).tBodies[0].rows].map((row) =>"
            " [...row.cells].map((cell) => cell.textContent))",
            selector,
        )

    def test_is_one_file_without_network_and_errors(self):
        events = [
            json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")
        ]
        asked = {
            event["params"]["request"]["url"]
            for event in events
            if event["method"] == "Network.requestWillBeSent"
        }
        page = (self.place / "compare.html").as_uri()
        self.assertEqual({url for url in asked if not url.startswith(("data:", "blob:"))}, {page})
        for name in ("point", "group", "filter"):
            list_ = Select(self.element(name))
            for index in range(len(list_.options)):
                list_.select_by_index(index)
        self.element("scheme").click()
        for details in self.driver.find_elements(By.CSS_SELECTOR, "figure summary"):
            details.click()
        self.assertEqual(self.driver.get_log("browser"), [])
        self.assertLessEqual(
            self.run_script("return document.documentElement.scrollWidth"),
            self.run_script("return innerWidth"),
        )

    def test_scope_is_printed_and_shown(self):
        notes = self.element("notes").text
        for text in (
            "1 of 3 points of the sweeps are common: friction 0.5.",
            "Not all variants have these points of base, which are not compared: friction 0.3.",
            "Not all variants have these points of coarser, which are not compared: friction 0.2.",
            "Modes of base and damped with stored shapes are matched by the MAC",
            "Modes of base and coarser are matched by name and frequency: the meshes of base",
        ):
            self.assertIn(f"compare: {text}", self.said)
            self.assertIn(text, notes)

    @staticmethod
    def middle(mark):
        """The middle of a circle, drawn from its left end, or of the box around other markers."""
        numbers = np.array(re.findall(r"-?[\d.]+", mark), float)
        if "a" in mark:
            return numbers[0] + numbers[2], numbers[1]
        corners = numbers.reshape(-1, 2)
        return (corners.min(axis=0) + corners.max(axis=0)) / 2

    def test_charts_show_the_eigenvalues(self):
        """At friction 0.5: the places of the markers on the scale that the labels of the axes
        give."""
        picture = ElementTree.fromstring(self.run_script("return textOf(charts[0].picture)"))
        tag = "{http://www.w3.org/2000/svg}"
        texts = picture.findall(f"{tag}text")
        scales = []
        for anchor, axis in (("middle", "x"), ("end", "y")):
            ends = [
                (float(one.get(axis)), float(one.text))
                for one in texts
                if one.get("text-anchor") == anchor and re.fullmatch(r"-?[\d.]+", one.text)
            ]
            scales.append(np.polyfit(*zip(*ends), 1))
        paths = [path for path in picture.findall(f"{tag}path") if path.get("fill-opacity")]
        self.assertEqual(len(paths), len(VARIANTS))
        for path, (name, run) in zip(paths, self.runs.items()):
            rows = run.eigenvalues.query(COMMON)
            grows = rows[rows["grows"]]
            marks = [self.middle(mark) for mark in path.get("d").split("M")[1:]]
            self.assertEqual(len(marks), len(grows), name)
            self.assertGreater(len(marks), 0)
            for (x, y), row in zip(marks, grows.itertuples()):
                # To 2 of 760 units. The labels of the vertical axis are 4 units below its ticks.
                hertz, percent = np.polyval(scales[0], x), np.polyval(scales[1], y + 4)
                self.assertAlmostEqual(hertz, row.frequency_hz, delta=2 * scales[0][0])
                self.assertAlmostEqual(
                    percent, 100 * row.damping_ratio, delta=2 * abs(scales[1][0])
                )
        self.driver.find_element(By.CSS_SELECTOR, "#stability summary").click()
        self.driver.implicitly_wait(5)
        self.driver.find_element(By.CSS_SELECTOR, "#stability table")
        cells = self.cells("#stability table")
        expected = [
            (name, f"{row.frequency_hz:.5g}", row.verdict)
            for name, run in self.runs.items()
            for row in run.eigenvalues.query(COMMON).itertuples()
        ]
        self.assertEqual([(c[0], f"{float(c[3]):.5g}", c[-1]) for c in cells], expected)
        Select(self.element("point")).select_by_visible_text("all points")
        self.assertEqual(
            len(self.cells("#stability table")), sum(len(r.eigenvalues) for r in self.runs.values())
        )

    def test_a_point_has_words_and_a_variant_can_be_hidden(self):
        row = self.runs["base"].eigenvalues.query(f"{COMMON} and grows").iloc[0]
        picture = self.driver.find_element(By.CSS_SELECTOR, "#stability > svg")
        self.run_script("arguments[0].scrollIntoView({block: 'center'})", picture)
        x, y = self.run_script(
            "const p = charts[0].picture, found = p.places.find((q) => q.text.startsWith('base') &&"
            " q.text.endsWith('unstable')); const r = p.getBoundingClientRect(), s = r.width / 760;"
            " return [found.x * s - r.width / 2, found.y * s - r.height / 2]"
        )
        ActionChains(self.driver).move_to_element_with_offset(picture, round(x), round(y)).perform()
        words = self.element("hover").text.split("\n")
        self.assertEqual(words[:2], ["base", f"mode {row['mode']} at friction 0.5"])
        self.assertAlmostEqual(float(words[2].split()[0]), row["frequency_hz"], delta=1e-3)
        boxes = self.driver.find_elements(By.CSS_SELECTOR, "#legend input")
        boxes[0].click()
        names = "return setsOf(charts[1]).map((set) => set.name)"
        self.assertEqual(self.run_script(names), ["damped", "coarser"])
        boxes[0].click()
        self.assertEqual(self.run_script(names), list(VARIANTS))

    def test_figures_are_saved(self):
        saved = self.driver.execute_async_script(
            "const done = arguments[0], found = {}; save = async (blob, name) => {"
            " found[name] = [...new Uint8Array(await blob.arrayBuffer())]"
            ".map((b) => String.fromCharCode(b)).join('');"
            " if (Object.keys(found).length === 2)"
            " done(Object.entries(found).map(([n, text]) => [n, btoa(text)])); };"
            " for (const one of document.querySelectorAll('#growth .controls button')) one.click();"
        )
        files = {name: base64.b64decode(text) for name, text in saved}
        self.assertEqual(sorted(files), ["growth.png", "growth.svg"])
        drawn = ElementTree.fromstring(files["growth.svg"])
        texts = {one.text for one in drawn.iter("{http://www.w3.org/2000/svg}text")}
        self.assertLessEqual({*VARIANTS, "growth rate [1/s]", "friction coefficient"}, texts)
        with Image.open(io.BytesIO(files["growth.png"])) as image:
            self.assertEqual((image.format, image.size), ("PNG", (1520, 860)))
            colours = {colour for _, colour in image.convert("RGB").getcolors(1 << 24)}
        self.assertLessEqual({(0x00, 0x72, 0xB2), (0xD5, 0x5E, 0x00), (255, 255, 255)}, colours)

    def test_tables_are_those_of_python(self):
        found = variants.read_variants([self.place / name for name in VARIANTS])
        ranks = variants.rankings(found)
        tables = self.driver.find_elements(By.CSS_SELECTOR, "#rankings table")
        shown = [
            [table.find_element(By.TAG_NAME, "caption").text, row.text.split()[:2]]
            for table in tables
            for row in table.find_elements(By.CSS_SELECTOR, "tbody tr")
        ]
        self.assertEqual(
            shown,
            [[f"By {row.criterion}", [str(row.rank), row.variant]] for row in ranks.itertuples()],
        )
        self.assertEqual(self.element("verdict").text, compare.sentence_of(ranks))
        options = self.cells("#changes table")
        self.assertEqual(
            {row[0] for row in options},
            {word for word in LOSS if word.startswith("-")} | {"-mesh_set", "-flutter_friction"},
        )
        self.assertIn(["-material_lining_loss_factor", "not given", "0.1", "not given"], options)
        base, damped, coarser = self.runs.values()
        growing = base.eigenvalues.query(f"{COMMON} and grows")
        row = growing.sort_values("growth_rate_1_per_s").iloc[-1]
        pairs = base.compare(damped).query(f"{COMMON} and mode == {row['mode']}").iloc[0]
        self.assertEqual(pairs["matched_by"], "MAC")
        self.assertGreater(pairs["mac"], 0.95)  # the damping hardly bends the mode
        self.assertLess(pairs["growth_change_1_per_s"], 0)
        cells = next(one for one in self.cells("#modes table") if one[0] == str(row["mode"]))
        self.assertAlmostEqual(float(cells[8]), pairs["frequency_change_hz"], delta=1e-3)
        change = pairs["growth_change_1_per_s"]  # shown to four digits
        self.assertAlmostEqual(float(cells[10]), change, delta=5e-4 * abs(change))
        self.assertEqual(cells[11], f"MAC {float(f'{pairs.mac:.3g}'):g}")
        with self.assertRaisesRegex(
            squeal.ResultsError, "the meshes of .*base and .*coarser differ"
        ):
            base.mac(coarser, friction=0.5)
        by = set(base.compare(coarser)["matched_by"])
        self.assertLessEqual(by, {"name", "frequency", ""})

    def test_names_are_text_not_markup(self):
        bad = "<b id=bad>"
        shutil.copytree(
            self.place / "damped", self.place / bad, ignore=shutil.ignore_patterns("vtk")
        )
        summary = json.loads((self.place / bad / "summary.json").read_text())
        summary["case"] = summary["verdict"]["sentence"] = f"</script>{bad}"
        (self.place / bad / "summary.json").write_text(json.dumps(summary))
        options = self.place / bad / "options.txt"
        options.write_text(re.sub("-mesh_set .*", f"-mesh_set {bad}", options.read_text()))
        subprocess.run(
            [COMMAND, "base", bad, "-o", "bad.html"],
            check=True,
            capture_output=True,
            cwd=self.place,
        )
        self.open_page("bad.html")
        self.assertEqual(self.driver.find_elements(By.ID, "bad"), [])
        for name in ("legend", "figures", "rankings", "changes", "modes", "notes", "critical"):
            self.assertIn(bad, self.element(name).get_attribute("textContent"), name)
        self.assertEqual(self.driver.get_log("browser"), [])

    def test_a_damaged_result_is_refused_by_name(self):
        page = (self.place / "compare.html").read_text()
        copy = self.place / "cut"
        shutil.copytree(self.place / "damped", copy, ignore=shutil.ignore_patterns("vtk"))
        table = copy / "eigenvalues.csv"
        table.write_text(table.read_text()[:-1000])
        done = subprocess.run(
            [COMMAND, "base", "cut"], capture_output=True, text=True, cwd=self.place
        )
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertRegex(
            done.stderr, r"^squeal-compare: cut/eigenvalues.csv: line \d+ is cut: .*\n$"
        )
        self.assertEqual((self.place / "compare.html").read_text(), page)


if __name__ == "__main__":
    unittest.main(verbosity=2)
