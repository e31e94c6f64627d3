#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The stability chart, the maps on the linings, saved figures and the printed report:
test_figures.py PROGRAM RESULTS."""
import csv
import math
import re
import subprocess
import unittest
import zlib
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pandas as pd
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import Select

from pages import Pages
from squeal import linings

SVG = "{http://www.w3.org/2000/svg}"
# How many pixels of an SVG and a PNG of one figure differ, and how many of the PNG are drawn: a
# quarter of the range from each other, and from the white paper. Letters, whose edges differ, are
# left out.
COMPARE = """
const [id, done] = arguments, kinds = [CanvasRenderingContext2D, SvgContext];
const written = kinds.map((kind) => kind.prototype.fillText);
for (const kind of kinds) kind.prototype.fillText = () => undefined;
const png = figures[id].canvas(), svg = figures[id].svg(), picture = new Image();
kinds.forEach((kind, k) => { kind.prototype.fillText = written[k]; });
const pixels = (source) => {
  const canvas = make("canvas", {width: 480, height: Math.round(png.height / 4)});
  const context = canvas.getContext("2d");
  context.drawImage(source, 0, 0, canvas.width, canvas.height);
  return context.getImageData(0, 0, canvas.width, canvas.height).data;
};
picture.onload = () => {
  const one = pixels(picture), other = pixels(png), parts = [0, 1, 2];
  let apart = 0, drawn = 0;
  for (let i = 0; i < one.length; i += 4) {
    if (parts.some((d) => Math.abs(one[i + d] - other[i + d]) > 64)) ++apart;
    if (parts.some((d) => other[i + d] < 191)) ++drawn;
  }
  done([apart, drawn]);
};
picture.src = URL.createObjectURL(svgBlob(svg));
"""


def number(text):
    return float(text.replace(",", "").replace("\u2212", "-"))


class Figures(Pages):
    def svg(self, name):
        return ElementTree.fromstring(self.run_script("return figures[arguments[0]].svg()", name))

    def indices(self):
        """The rows of the table next to the stability chart."""
        return self.run_script(
            "return [...element('indices').querySelectorAll('tbody tr')]"
            ".map((row) => [...row.cells].map((cell) => cell.textContent))"
        )

    def test_the_stability_chart_is_that_of_the_eigenvalues(self):
        drawn = self.run_script(
            "element('dampingrange').value = stability.range = 'all'; drawStability();"
            "return stability.chart.data.datasets.slice(0, -1).flatMap((set) => set.data)"
        )
        self.assertEqual(len(drawn), len(self.rows))
        for point in drawn:
            row = self.rows[point["row"]]
            self.assertEqual(point["x"], float(row["frequency_hz"]))
            # The table has 16 digits of both parts of s.
            self.assertAlmostEqual(point["y"], 100 * float(row["damping_ratio"]), delta=1e-12)
        scales = self.run_script(
            "const {y, index} = stability.chart.scales; return [[y.min, y.max],"
            " [-index.max / 2, -index.min / 2], y.ticks.map((t) => t.value),"
            " index.ticks.map((t) => -t.value / 2)]"
        )
        np.testing.assert_allclose(scales[0], scales[1], rtol=1e-12)
        np.testing.assert_allclose(sorted(scales[2]), sorted(scales[3]), atol=1e-12)

    def test_the_squeal_index_ranks_the_table(self):
        index = [
            200
            * float(row["growth_rate_1_per_s"])
            / math.hypot(
                float(row["growth_rate_1_per_s"]), float(row["angular_frequency_rad_per_s"])
            )
            for row in self.rows
        ]
        listed = self.indices()
        found = [number(cells[4]) for cells in listed]
        # Cells have four digits.
        np.testing.assert_allclose(found, sorted(index, reverse=True)[: len(found)], rtol=6e-4)
        self.assertGreater(found[0], 1)
        worst = index.index(max(index))
        self.driver.find_element(By.CSS_SELECTOR, "#indices tbody tr").click()
        self.assertEqual(self.run_script("return state.selected"), worst)
        Select(self.element("dampingpoints")).select_by_value("one")
        friction = self.rows[worst]["friction"]
        same = [row for row in self.rows if row["friction"] == friction]
        self.assertEqual(len(self.indices()), len(same))
        Select(self.element("dampingpoints")).select_by_value("all")

    def test_eigenvalues_beyond_the_chart_are_counted(self):
        Select(self.element("dampingrange")).select_by_value("all")
        self.assertEqual(self.element("beyond").text, "")
        beyond = self.run_script(
            "eigen.growth_rate_1_per_s[5] = -0.4 * angular(5); stability.range = 'near';"
            "drawStability(); const text = element('beyond').textContent;"
            "eigen.growth_rate_1_per_s[5] = 0; drawStability(); return text"
        )
        self.assertEqual(
            beyond, f"Outside of the chart, with more damping: 1 of {len(self.rows)} eigenvalues"
        )

    def test_svg_is_a_vector_figure_of_the_numbers(self):
        """Circles lie at the numbers that the ticks of the axes give to their places."""
        self.select(0.4, 3)
        root = self.svg("damping")
        texts = [
            (
                node.text,
                *(
                    float(node.get(key)) + shift
                    for key, shift in zip("xy", self.shifts(node.get("transform")))
                ),
            )
            for node in root.iter(SVG + "text")
        ]
        words = [text for text, _, _ in texts]
        for wanted in ("frequency [Hz]", "damping ratio [%]", "friction 0.4", "unstable"):
            self.assertIn(wanted, words)
        self.assertIn(root.find(SVG + "title").text, words)
        ticks = [one for one in texts if re.fullmatch(r"[-−]?[\d,.]+", one[0])]
        lowest = max(y for _, _, y in ticks)
        across = np.array([(number(t), x) for t, x, y in ticks if abs(y - lowest) < 1])
        left = min(x for _, x, y in ticks if abs(y - lowest) > 1)
        middle = 0.35 * 12  # from the baseline of a number to its middle
        up = np.array(
            [(number(t), y - middle) for t, x, y in ticks if x == left and lowest - y > 1]
        )
        place = [np.polyfit(one[:, 1], one[:, 0], 1) for one in (across, up)]
        circles = []
        for node in root.iter(SVG + "path"):
            arc = re.match(r"M([\d.]+) ([\d.]+)A([\d.]+) \S+ 0 0 1 ([\d.]+) ", node.get("d"))
            if arc and node.get("fill") != "none" and float(arc[2]) > up[:, 1].min() - 8:
                circles.append(((float(arc[1]) + float(arc[4])) / 2, float(arc[2])))
        wanted = np.array(
            [(float(row["frequency_hz"]), 100 * float(row["damping_ratio"])) for row in self.rows]
        )
        circles = [(np.polyval(place[0], x), np.polyval(place[1], y)) for x, y in circles]
        self.assertEqual(len(circles), len(wanted))
        scale = np.ptp(across[:, 0]), np.ptp(up[:, 0])
        for point in wanted:  # to a pixel or so of 700
            far = np.abs((np.array(circles) - point) / scale).max(axis=1)
            self.assertLess(far.min(), 0.003)

    @staticmethod
    def shifts(matrix):
        values = [float(value) for value in matrix[len("matrix(") : -1].split(",")]
        return values[4:]

    def test_svg_and_png_show_the_same(self):
        names = self.run_script("return Object.keys(figures)")
        self.assertLessEqual({"frequency", "growth", "roots", "damping", "map0"}, set(names))
        for name in names:
            apart, drawn = self.driver.execute_async_script(COMPARE, name)
            self.assertGreater(drawn, 500, name)
            # Edges of lines and circles differ.
            self.assertLess(apart / drawn, 0.3, name)

    def test_buttons_save_what_they_name(self):
        offered = self.driver.execute_async_script(
            "const done = arguments[0], found = [], before = offer;"
            "offer = (name, blob) => found.push([name, blob.type, blob.size]);"
            "for (const button of document.querySelectorAll('.save button')) button.click();"
            "setTimeout(() => { offer = before; done(found); }, 3000)"
        )
        kinds = {name: kind for name, kind, _ in offered}
        charts = self.run_script("return Object.keys(figures)")
        self.assertEqual(
            kinds,
            {
                **{f"coarse_{name}.svg": "image/svg+xml" for name in charts},
                **{f"coarse_{name}.png": "image/png" for name in [*charts, "shape"]},
            },
        )
        self.assertGreater(min(size for _, _, size in offered), 3000)

    def integral(self, field):
        """The integral of a field over the map, by triangles."""
        places, triangles, values = self.run_script(
            "const face = maps2d.faces[0]; return [Array.from(face.places),"
            " Array.from(face.triangles), mapValues(face, arguments[0])]",
            field,
        )
        corners = np.reshape(places, (-1, 2))[np.reshape(triangles, (-1, 3))]
        one, two = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        area = np.abs(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]) / 2
        return (area * np.array(values)[np.reshape(triangles, (-1, 3))].mean(axis=1)).sum()

    def test_maps_have_the_force_and_the_friction_work_of_the_tables(self):
        friction, mode = self.kept()[0]
        self.select(friction, mode)
        self.driver.execute_async_script("showMaps().then(arguments[0])")
        with open(self.folder / f"steady_{friction:g}.csv", newline="") as file:
            force = sum(float(row["normal_force_n"]) for row in csv.DictReader(file))
        # Shares of area of quadrilaterals' nodes and of their triangles' differ.
        self.assertAlmostEqual(self.integral("pressure") / force, 1, delta=0.03)
        with open(self.folder / "friction_work.csv", newline="") as file:
            work = next(
                float(row["friction_work_1_per_s"])
                for row in csv.DictReader(file)
                if float(row["friction"]) == friction and int(row["mode"]) == mode
            )
        self.assertAlmostEqual(self.integral("work") / work, 1, delta=0.05)

    def test_a_map_is_seen_from_the_disc(self):
        """The pad lies on the disc, which turns about +z, and the eye below the pad looks up: the
        friction on the pad, along +y, points to the right if x points up."""
        face = self.run_script(
            "const {name, sliding, friction, places} = maps2d.faces[0];"
            "return {name, sliding, friction, places: Array.from(places)}"
        )
        self.assertEqual((face["name"], face["sliding"]), ("pad", True))
        self.assertGreater(face["friction"][0], 0.99)
        ends = np.reshape(face["places"], (-1, 2))
        self.assertGreater(ends[:, 1].min(), 0.05)  # above the axis, m

    def test_an_interface_without_force_has_no_direction(self):
        names = "normal_force_n friction_force_x_n friction_force_y_n friction_force_z_n".split()
        for normal, friction, wanted in (
            (-1e-13, 0.0, None),
            (0.0, 0.0, None),
            (10.0, 3.0, [1, 0]),
        ):
            rows = [pd.DataFrame([[normal, friction, 0.0, 0.0]], columns=names)]
            self.assertEqual(linings._direction(rows, np.eye(3)), wanted)

    def test_maps_have_a_scale_with_units_and_a_table(self):
        Select(self.element("mapfield")).select_by_value("pressure")
        root = self.svg("map0")
        words = [node.text for node in root.iter(SVG + "text")]
        self.assertIn("MPa", words)
        self.assertIn("pad", words)
        areas = {
            node.get("fill")
            for node in root.iter(SVG + "path")
            if node.get("stroke-width") == "0.6"
        }
        self.assertLessEqual(len(areas), 12)
        count = self.run_script("return element('maptable').querySelectorAll('tbody tr').length")
        self.assertEqual(count, self.run_script("return maps2d.faces[0].nodes.length"))
        Select(self.element("mapfield")).select_by_value("gap")
        self.assertIn("gap m", self.run_script("return element('maptable').textContent"))
        Select(self.element("mapfield")).select_by_value("pressure")

    def test_print_cuts_no_chart(self):
        """The PDF has one image of each canvas: one that is cut would be on two pages."""
        path = Path(self.temporary.name) / "report.pdf"
        words = "headless=new no-sandbox use-gl=angle use-angle=swiftshader ignore-gpu-blocklist"
        words += " enable-unsafe-swiftshader force-prefers-reduced-motion no-pdf-header-footer"
        words += f" virtual-time-budget=600000 print-to-pdf={path}"
        subprocess.run(
            ["chromium", *(f"--{word}" for word in words.split()), self.page.as_uri()],
            check=True,
            capture_output=True,
            timeout=120,
        )
        content = path.read_bytes()
        canvases = self.run_script(
            "return [...document.querySelectorAll('canvas')].filter((one) =>"
            " one.offsetParent).length"
        )
        self.assertGreaterEqual(canvases, 7)
        images = list(images_of(content))
        self.assertEqual(len(images), canvases)
        # The view and the map are mostly white: a view that was not drawn would be black.
        brightness = [pixels.mean() for pixels, opaque in images if opaque]
        self.assertEqual(len(brightness), 2)
        self.assertGreater(min(brightness), 100)
        self.assertGreater(len(re.findall(rb"/Type /Page\b", content)), 2)


def images_of(content):
    """The colours of the large images in a PDF by Chromium, and whether they are opaque."""
    form = rb"^\d+ 0 obj\s<<([^\0]*?)>> ?stream\r?\n"
    for head in re.finditer(form, content, re.M):
        number_of = {key: int(value) for key, value in re.findall(rb"/(\w+) (\d+)\n?", head[1])}
        if (
            b"/Subtype /Image" not in head[1]
            or b"/DeviceGray" in head[1]
            or number_of[b"Width"] < 300
        ):
            continue
        packed = content[head.end() : head.end() + number_of[b"Length"]]
        yield np.frombuffer(zlib.decompress(packed), np.uint8), b"/SMask" not in head[1]


if __name__ == "__main__":
    unittest.main(verbosity=2)
