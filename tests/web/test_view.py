#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The view of a mode in the report: test_view.py PROGRAM RESULTS."""
import itertools
import re
import unittest
from pathlib import Path
from unittest import mock

import h5py
import numpy as np
from scipy.spatial.transform import Rotation
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import WebDriverWait

from pages import Pages, browser
import squeal
from squeal import report, shapes
from squeal.exploded import STEP, offsets, rotation_of
from squeal.skin import Skin


class View(Pages):
    OPEN_PAGES = {
        "test_webgl_that_is_lost",
        "test_without_webgl_diagrams_and_tables_live",
    }

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
        with mock.patch.object(shapes, "Skin", return_value=whole):
            self.assertIn("Bodies that are smaller are not drawn: pin, shim.", report.build(run))
        self.assertNotIn("Bodies that are smaller", report.build(run))

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

    def states(self):
        return self.run_script("return view.bodies.map(({state}) => state)")

    def test_bodies_are_shown_transparent_or_hidden(self):
        self.select(*self.kept()[0])
        self.run_script("element('show').value = 'all'; showBodies(); play(false);")
        names = self.run_script("return data.skin.bodies.map(({name}) => name)")
        self.assertEqual(self.states(), ["shown"] * len(names))
        place = names.index("disc")
        pictures = [self.turn_to(0, 0)]
        for state, opacity, visible in (
            ("transparent", 0.16, True),
            ("hidden", 1, False),
            ("shown", 1, True),
        ):
            button = self.element("bodies").find_elements(By.TAG_NAME, "button")[place]
            button.send_keys(Keys.ENTER)
            self.assertEqual(self.states()[place], state)
            self.assertEqual(button.get_attribute("aria-label"), f"disc: {state}")
            material = self.run_script(
                "const {mesh, outline} = view.bodies[arguments[0]];"
                "return [mesh.material.opacity, mesh.visible, outline.visible]",
                place,
            )
            self.assertEqual(material, [opacity, visible, visible])
            pictures.append(self.turn_to(0, 0))
        self.assertEqual(pictures[0], pictures[-1])
        self.assertEqual(len(set(pictures)), 3)
        self.assertEqual(self.element("show").get_attribute("value"), "chosen")
        self.select(*self.kept()[1])  # keeps a choice
        self.assertEqual(self.element("show").get_attribute("value"), "chosen")
        self.run_script("element('show').value = 'energy'; showBodies();")

    def test_the_first_view_estimates_the_energies(self):
        """Volumes are masses over densities, the mean squares those of the mode."""
        friction, mode = self.kept()[0]
        self.run_script("componentRows.clear()")
        self.select(friction, mode)
        run = squeal.open(self.folder)
        skin = Skin(run.mesh)
        mass = re.findall(r"^\| (\w+) \| \d+ \| ([\d.e+-]+) \|", self.audit(), re.M)
        volume = {
            name: float(kg) / float(run.summary["options"][f"material_{name}_density"])
            for name, kg in mass
            if name != "total"
        }
        square = (np.abs(run.mode(mode, friction=friction).shape) ** 2).sum(axis=1)
        wanted = [
            volume[body["name"]] * square[skin.nodes[slice(*body["nodes"])]].mean()
            for body in skin.bodies
        ]
        found = self.run_script("return energiesOfBodies().values")
        # Five digits of a mass, quadrilaterals as two triangles, 127ths of the motion.
        np.testing.assert_allclose(
            np.array(found) / sum(found), np.array(wanted) / sum(wanted), atol=0.01
        )
        order = np.argsort(wanted)[::-1]
        few = 1 + int(np.argmax(np.cumsum(np.array(wanted)[order]) >= 0.8 * sum(wanted)))
        shown = {k for k, state in enumerate(self.states()) if state == "shown"}
        self.assertEqual(shown, set(order[:few]))
        type(self).page = None  # without a table

    def audit(self):
        return (self.folder / "audit.md").read_text()

    def test_the_slider_pulls_the_bodies_apart(self):
        """The pad's bodies move up from the disc, one step each; all stay in the view."""
        apart = self.run_script(
            "play(false); const slider = element('explode'); slider.value = 0.5; explode();"
            "return Object.fromEntries(data.skin.bodies.map(({name}, k) => [name,"
            " view.bodies[k].mesh.position.toArray()]))"
        )
        np.testing.assert_allclose(apart["disc"], apart["hat"], atol=1e-12)
        step = np.subtract(apart["lining"], apart["disc"])
        np.testing.assert_allclose(step, [0, 0, STEP / 2], atol=1e-12)
        np.testing.assert_allclose(np.subtract(apart["back_plate"], apart["disc"]), 2 * step)
        half = self.turn_to(0, 0)
        corners = self.run_script(
            "element('explode').value = 1; explode();"
            "return data.skin.bodies.flatMap(({apart}, k) => ['min', 'max'].map((end) =>"
            " view.bodies[k].box[end].clone().add(new THREE.Vector3(...apart))"
            ".project(view.camera).toArray().slice(0, 2)))"
        )
        self.assertLessEqual(np.abs(corners).max(), 1)
        whole = self.turn_to(0, 0)
        self.run_script("element('explode').value = 0; explode();")
        self.assertEqual(len({self.turn_to(0, 0), half, whole}), 3)

    def test_bodies_on_both_sides_of_a_disc_move_outwards(self):
        """A disc, a pad on each side and a caliper over both, as boxes."""
        boxes = {
            "disc": ((-1, -1, -0.1), (1, 1, 0.1)),
            "inner": ((0.5, -0.2, -0.3), (1, 0.2, -0.1)),
            "outer": ((0.5, -0.2, 0.1), (1, 0.2, 0.3)),
            "caliper": ((0.5, -0.3, -0.6), (1.3, 0.3, 0.6)),
        }
        places = np.concatenate(
            [np.array(list(itertools.product(*zip(*b)))) for b in boxes.values()]
        )
        bodies = [{"name": name, "nodes": [8 * k, 8 * k + 8]} for k, name in enumerate(boxes)]
        faces = [{"sliding": True, "height": height} for height in (-0.1, 0.1)]
        options = {"motion_disc_speed": "5", "motion_disc_axis": "0,0,2"}
        axis, origin, rotors = rotation_of(options, bodies)
        self.assertEqual((axis.tolist(), origin.tolist(), rotors), ([0, 0, 1], [0, 0, 0], ["disc"]))
        moved = offsets(places, bodies, (axis, origin, rotors), faces)
        moved = dict(zip(boxes, moved - moved[0]))
        step = STEP * 2.3  # from -1 to 1.3
        np.testing.assert_allclose(moved["inner"], [0, 0, -step], atol=1e-12)
        np.testing.assert_allclose(moved["outer"], [0, 0, step], atol=1e-12)
        np.testing.assert_allclose(moved["caliper"], [1.5 * step, 0, 0], atol=1e-12)
        self.assertIsNone(rotation_of({"motion_disc_speed": "0"}, bodies))
        still = offsets(places, bodies, None, [])  # away from the middle (0.15, 0, 0)
        np.testing.assert_allclose(still[2], 1.2 * np.array([0.6, 0, 0.2]), atol=1e-12)


if __name__ == "__main__":
    unittest.main(verbosity=2)
