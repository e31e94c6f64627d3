# SPDX-License-Identifier: BSD-2-Clause
"""The report of a run, opened in Chromium. The tests of the report derive from Pages; their
arguments are PROGRAM and RESULTS, the results of the run."""
import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import WebDriverWait

repository = Path(__file__).resolve().parents[2]
folders = ("python", "scripts/dev", "tests/support/harness", "tests/support/run")
sys.path[:0] = [str(repository / folder) for folder in folders]
sys.dont_write_bytecode = True
import coarse_brake
from report_picture import browser

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")
MADE = sys.argv.pop(1) if len(sys.argv) > 1 else None


def rows(path):
    """The rows of a table."""
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class Pages(unittest.TestCase):
    """One report and one browser for all tests of a class."""

    RUN = coarse_brake.RUN
    OPEN_PAGES = set()  # the tests that open pages by themselves, whatever page is open

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.folder = Path(cls.temporary.name) / "coarse"
        cls.RUN.place(PROGRAM, MADE, cls.folder)
        subprocess.run(
            [repository / "scripts/squeal-report", cls.folder],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        cls.rows = rows(cls.folder / "eigenvalues.csv")
        cls.driver = browser(browser="ALL", performance="ALL")
        cls.addClassCleanup(cls.driver.quit)
        cls.page = None

    def setUp(self):
        if self.page != self.folder / "report.html" and self._testMethodName not in self.OPEN_PAGES:
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


__all__ = ["Pages", "browser", "repository"]
