#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Shares of the components, participation of the free modes and ranked changes in the report:
test_shares.py PROGRAM RESULTS. The tables of shares are made here."""
import shutil
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
from selenium.webdriver.common.by import By

from pages import Pages, rows
import made_tables
import squeal
from squeal import report

BAD = "<b id=bad>shim"
BY_ITSELF = "Elastic modes of each body by itself"
OWN_MODES = [
    ("disc", 1, 1234.5678, "disc (0,2) out of plane", 0.98765),
    ("disc", 2, 2345.6789, "", ""),
    (BAD, 1, 4567.8912, "bending 1", 0.75),
]


class Shares(Pages):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        run = squeal.open(cls.folder)
        names = [("body", name) for name in run.mesh.bodies]
        cls.made = Path(cls.temporary.name) / "made"
        shutil.copytree(cls.folder, cls.made, ignore=shutil.ignore_patterns("vtk", "report.html"))
        made_tables.write(cls.made, run, [*names, ("interface", "disc"), ("layer", BAD)])
        made_tables.write_component_modes(cls.made, OWN_MODES)
        (cls.made / "report.html").write_text(report.build(squeal.open(cls.made)))
        cls.components = rows(cls.made / "components.csv")
        cls.participation = rows(cls.made / "participation.csv")

    def setUp(self):
        if self.page != self.made / "report.html":
            self.open_page(self.made / "report.html")

    def label(self, row):
        """A component of a kind other than body has its kind in its label."""
        return row["component"] + (f" ({row['kind']})" if row["kind"] != "body" else "")

    def of_mode(self, table, friction, mode):
        return [
            row for row in table if float(row["friction"]) == friction and int(row["mode"]) == mode
        ]

    def drawn(self, name):
        """The labels of a chart, and its values by set and bar."""
        labels, sets = self.run_script(
            "const {labels, datasets} = barCharts[arguments[0]].data;"
            "return [labels, datasets.map((set) => [set.label || '', set.data])]",
            name,
        )
        return labels, dict(sets)

    def cells(self, name, table=0):
        """The head and the body of a table."""
        return self.run_script(
            "const table = element(arguments[0]).querySelectorAll('table')[arguments[1]];"
            "return [...table.rows].map((row) => [...row.cells].map((cell) => cell.textContent))",
            name,
            table,
        )

    def test_bars_have_the_shares_of_all_modes_of_the_point(self):
        friction, mode = self.kept()[0]
        self.select(friction, mode)
        modes = [one for at, one in self.kept() if at == friction]
        for name, column in (("kinetic", "kinetic_share"), ("strain", "strain_share")):
            labels, sets = self.drawn(name)
            self.assertEqual([int(text.strip("▶ ").split(":")[0]) for text in labels], modes)
            self.assertTrue(labels[modes.index(mode)].startswith("▶"))
            self.assertEqual(len(sets), 6)
            np.testing.assert_allclose(sum(map(np.array, sets.values())), 100, rtol=1e-12)
            for place, one in enumerate(modes):
                for row in self.of_mode(self.components, friction, one):
                    # The made shares have 16 digits.
                    self.assertAlmostEqual(
                        sets[self.label(row)][place], 100 * float(row[column]), delta=1e-12
                    )

    def test_contributions_add_up_to_the_growth_rate(self):
        for friction, mode in self.kept()[:2]:
            self.select(friction, mode)
            labels, sets = self.drawn("contributions")
            table = self.of_mode(self.components, friction, mode)
            growth = float(table[0]["growth_rate_1_per_s"])
            self.assertAlmostEqual(sum(map(sum, sets.values())), growth, delta=1e-9 * growth)
            self.assertEqual(labels[0], "disc (interface)")  # by far the largest
            pad = next(row for row in table if row["kind"] == "interface")
            self.assertEqual(
                [sets["friction, follower part"][0], sets["friction damping"][0]],
                [float(pad[name]) for name in ("follower_1_per_s", "friction_damping_1_per_s")],
            )
            self.assertNotIn("gyroscopic terms", sets)  # all zero
            self.assertIn(
                f"Growth rate of the mode: {growth:.6g} 1/s", self.text("contributionsum")
            )
            listed = {line[0]: line for line in self.cells("sharetables", 1)[1:]}
            self.assertAlmostEqual(
                float(listed["disc (interface)"][2]),
                float(pad["follower_1_per_s"]),
                delta=1e-4 * abs(growth) * 2,
            )

    def text(self, name):
        return self.run_script("return element(arguments[0]).textContent", name)

    def test_participation_is_that_of_the_table(self):
        friction, mode = self.kept()[1]
        self.select(friction, mode)
        table = self.of_mode(self.participation, friction, mode)
        labels, sets = self.drawn("participation")
        shares = [100 * float(row["energy_share"]) for row in table]
        np.testing.assert_allclose(sets[""], [*shares[:10], sum(shares[10:])], rtol=1e-12)
        self.assertTrue(labels[0].startswith(f"free mode {table[0]['free_mode']}: "))
        self.assertEqual(labels[-1], "all others")
        self.assertEqual(len(self.cells("sharetables", 2)), 1 + len(table))

    def more(self, title):
        """The headings and the tables of a section below the eigenvalues; None without it."""
        return self.run_script(
            "const box = [...element('more').querySelectorAll('details')].find((one) =>"
            " one.querySelector('summary').textContent === arguments[0]);"
            "return box && [[...box.querySelectorAll('h3')].map((one) => one.textContent),"
            " [...box.querySelectorAll('table')].map((table) => [...table.rows].map((row) =>"
            " [...row.cells].map((cell) => cell.textContent)))]",
            title,
        )

    def test_modes_of_bodies_by_themselves_have_a_table_for_each_body(self):
        bodies, tables = self.more(BY_ITSELF)
        self.assertEqual(bodies, ["disc", BAD])
        head = ["mode", "frequency Hz", "motion", "share %"]
        first = ["1", "1234.5678", "disc (0,2) out of plane", "98.77"]
        self.assertEqual(tables[0], [head, first, ["2", "2345.6789", "", ""]])
        self.assertEqual(tables[1], [head, ["1", "4567.8912", "bending 1", "75"]])

    def test_the_bodies_with_most_kinetic_energy_are_shown_first(self):
        for friction, mode in self.kept()[:3]:
            self.select(friction, mode)
            energy = {
                row["component"]: float(row["kinetic_share"])
                for row in self.of_mode(self.components, friction, mode)
                if row["kind"] == "body"
            }
            order = sorted(energy, key=energy.get, reverse=True)
            reached = np.cumsum([energy[name] for name in order])
            first = 1 + int(np.argmax(reached >= 0.8 * reached[-1] - 1e-12))
            states = self.run_script(
                "return Object.fromEntries(data.skin.bodies.map(({name}, k) => [name,"
                " view.bodies[k].state]))"
            )
            shown = {name for name, state in states.items() if state == "shown"}
            self.assertEqual(shown, set(order[:first]))
            self.assertIn("Most kinetic energy: " + order[0], self.text("energetic"))

    def test_changes_are_derivatives_for_one_per_cent(self):
        friction, mode = self.kept()[0]
        self.select(friction, mode)
        table = self.of_mode(rows(self.folder / "sensitivities.csv"), friction, mode)
        wanted = {
            row["parameter"]: [
                float(row[name]) / 100 * (friction if row["parameter"] == "friction" else 1)
                for name in ("growth_rate_derivative_1_per_s", "frequency_derivative_hz")
            ]
            for row in table
        }
        for part, name in enumerate(("growthchange", "frequencychange")):
            labels, sets = self.drawn(name)
            for label, value in zip(labels, sets[""]):
                self.assertAlmostEqual(value, wanted[label][part], delta=1e-12 * abs(value))
        order = sorted(wanted, key=lambda name: -abs(wanted[name][0]))
        moved = [name for name in order if any(wanted[name])]
        self.assertGreater(len(order), len(moved))  # the speed has no influence here
        self.assertEqual(self.drawn("growthchange")[0], moved[:15])
        self.assertEqual({line[0] for line in self.cells("changetable")[1:]}, set(order))

    def test_changes_of_a_critical_friction_are_its_derivatives_for_one_per_cent(self):
        derivatives = rows(self.folder / "critical_sensitivities.csv")
        criticals = rows(self.folder / "critical.csv")
        chosen = next(i for i, row in enumerate(criticals) if row["kind"] == "coalescence")
        critical = criticals[chosen]
        self.run_script(
            "const choice = element('criticalchoice'); choice.value = arguments[0];"
            "choice.dispatchEvent(new Event('change'))",
            str(chosen),
        )
        of_this = ("active_set", "branch", "partner", "friction")
        wanted = {
            row["parameter"]: float(row["friction_derivative"]) / 100
            for row in derivatives
            if all(row[name] == critical[name] for name in of_this)
        }
        labels, sets = self.drawn("criticalchange")
        order = sorted(wanted, key=lambda name: -abs(wanted[name]))
        self.assertEqual(labels, [name for name in order if wanted[name]][:15])
        np.testing.assert_allclose(sets[""], [wanted[name] for name in labels], rtol=1e-12)
        self.assertEqual(len(self.cells("criticalchangetable")), 1 + len(wanted))
        for name in ("free_mode", "second_free_mode"):
            self.assertIn(f"{critical[name]} (", self.text("criticalwords"))

    def test_a_mode_without_shares_says_so(self):
        self.select(0, 3)
        self.assertTrue(self.element("noshares").is_displayed())
        self.assertTrue(self.element("nochanges").is_displayed())
        for name in ("energies", "contributionframe", "participationframe", "changeframe"):
            self.assertFalse(self.element(name).is_displayed(), name)
        self.select(*self.kept()[0])
        self.assertFalse(self.element("noshares").is_displayed())
        self.assertTrue(self.element("energies").is_displayed())

    def test_names_are_text_and_nothing_is_logged(self):
        for place in ("sharetables", "more"):
            self.assertIn(BAD, self.text(place))
        self.assertEqual(self.driver.find_elements(By.ID, "bad"), [])
        label = "&lt;b id=bad&gt;shim (layer)</text>"
        self.assertIn(label, self.run_script("return figures.kinetic.svg()"))
        self.assertEqual(self.driver.get_log("browser"), [])

    def test_the_name_of_a_shape_is_shown_with_its_mode(self):
        friction, mode = self.kept()[0]
        self.run_script("eigen.name = rows.map(() => 'disc (0,4) out of plane')")
        self.select(friction, mode)
        self.assertIn(" Hz · disc (0,4) out of plane · growth ", self.text("chosen"))
        svg = self.run_script("return figures.contributions.svg()")
        self.assertIn(" Hz, disc (0,4) out of plane</title>", svg)
        self.run_script("delete eigen.name")

    def test_without_the_tables_their_sections_are_hidden(self):
        less = Path(self.temporary.name) / "less"
        shutil.copytree(self.folder, less, ignore=shutil.ignore_patterns("vtk", "report.html"))
        run = squeal.open(less)
        left = {"sensitivities", "critical_sensitivities", *made_tables.TABLES}
        with mock.patch.object(
            run, "_tables", {k: v for k, v in run._tables.items() if k not in left}
        ):
            (less / "report.html").write_text(report.build(run))
        self.open_page(less / "report.html")
        for name in ("shares", "changes", "criticalchanges"):
            self.assertFalse(self.element(name).is_displayed(), name)
        self.assertIsNone(self.more(BY_ITSELF))
        self.assertIsNotNone(self.more("Points of the sweep"))
        self.assertTrue(self.element("stability").is_displayed())
        self.assertIn("estimated from the surface", self.text("energetic"))
        self.assertEqual(self.driver.get_log("browser"), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
