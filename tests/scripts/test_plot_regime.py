# SPDX-License-Identifier: BSD-2-Clause
"""The picture of the motion after flutter, from tables made by hand."""
import math
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
KEYS = "friction,speed,pressure,damping,start"
POINT = "0.4,1,1,1"


class Picture(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.write("summary.json", '{"version": "0.1.0", "complete": true}\n')
        self.write(
            "manifest.txt", "# squeal 0.1.0: the 2 files of a run\nmanifest.txt\nsummary.json\n"
        )

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def tables(self, starts, unmeasured=()):
        columns = "class,settled,carrier_hz,flutter_frequency_hz,onset_kinetic_energy_j"
        self.write(
            "regime.csv",
            f"{KEYS},{columns}\n"
            + "".join(f"{POINT},{start},nothing measured,0,,1000,0.05\n" for start in unmeasured)
            + "".join(f"{POINT},{start},periodic,1,990,1000,0.05\n" for start in starts),
        )
        rows = {
            "nodes": (
                "x_m,y_m,z_m,interface,open,stick,slip",
                [f"{i},{i % 3},0.1,pad,0.{i},0,{1 - i / 10}" for i in range(9)],
            ),
            "cycles": (
                "cycle,time_s,largest_kinetic_energy_j",
                [f"{i},{i / 1000},{math.exp(i)}" for i in range(1, 9)],
            ),
            "spectrum": (
                "frequency_hz,velocity_sqrt_kg_m_per_s",
                [f"{100 * i},{1 / (1 + i)}" for i in range(30)],
            ),
        }
        for name, (columns, lines) in rows.items():
            self.write(
                f"regime_{name}.csv",
                f"{KEYS},{columns}\n"
                + "".join(f"{POINT},{start},{line}\n" for start in starts for line in lines),
            )

    def plot(self, *words):
        return subprocess.run(
            [ROOT / "scripts" / "squeal-plot", "regime", self.folder, *words],
            capture_output=True,
            text=True,
        )

    def test_it_is_drawn_and_listed(self):
        self.tables(["28", "all"])
        for words in ((), ("all",)):
            run = self.plot(*words)
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            self.assertEqual((self.folder / "regime.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
            self.assertIn("regime.png\n", (self.folder / "manifest.txt").read_text())

    def test_the_package_is_a_command_too(self):
        self.tables(["28"])
        environment = {
            **os.environ,
            "PYTHONPATH": str(ROOT / "python"),
            "PYTHONDONTWRITEBYTECODE": "1",
        }
        command = ["/usr/bin/python3", "-m", "squeal.plot", "regime", self.folder]
        run = subprocess.run(command, capture_output=True, text=True, env=environment)
        self.assertEqual(
            (run.returncode, run.stdout, run.stderr), (0, f"{self.folder}/regime.png\n", "")
        )

    def test_runs_that_have_measured_nothing_are_passed_over(self):
        self.tables(["28"], unmeasured=["12"])
        self.assertEqual(self.plot().returncode, 0)
        for words, starts in ((("12",), ["28"]), ((), [])):
            self.tables(starts, unmeasured=["12"])
            run = self.plot(*words)
            self.assertEqual(run.returncode, 1)
            self.assertIn("start on mode 12: nothing measured", run.stderr)

    def test_what_is_not_there_is_told(self):
        self.assertIn("no regime.csv", self.plot().stderr)
        self.tables(["28"])
        run = self.plot("29")
        self.assertEqual(run.returncode, 1)
        self.assertIn("no run of start 29", run.stderr)
        self.tables([])
        self.assertIn("has no run", self.plot().stderr)
        self.assertFalse((self.folder / "regime.png").exists())


if __name__ == "__main__":
    unittest.main()
