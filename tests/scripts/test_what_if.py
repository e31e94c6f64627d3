# SPDX-License-Identifier: BSD-2-Clause
"""squeal-run -what_if: predictions of the derivatives beside a second run. Call: test_what_if.py,
with the program in build/."""
import csv
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

import pandas as pd

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
sys.dont_write_bytecode = True
from squeal import what_if
from squeal.files import ResultsError

COARSE = "n_pad_theta=2,n_free_theta=6,n_mount=1,n_plate=1,n_inside=1,n_pad_r=2,n_hat=1,n_h_ring=1"


def squeal_run(folder, *words):
    return subprocess.run(
        [ROOT / "scripts/squeal-run", *words],
        env=dict(os.environ, NP="1"),
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )


def rows(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class Runs(unittest.TestCase):
    def test_predictions_are_those_of_the_tables(self):
        """The verdict "as predicted" stands exactly where the change misses the prediction by 2 %
        of itself or less; both are computed here from the tables of the two runs."""
        words = "-quiet -modes_count 30 -flutter_friction 0,0.3".split()
        with tempfile.TemporaryDirectory() as folder:
            run = squeal_run(
                folder,
                "disc_brake",
                "-mesh_set",
                COARSE,
                *words,
                "-what_if",
                "lining.young=1.01",
                "-what_if",
                "disc.density=0.999",
            )
            self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
            base = Path(folder) / "results/disc_brake"
            changed = Path(folder) / "results/disc_brake_what_if"
            derivatives = rows(base / "critical_sensitivities.csv")
            before, after = (rows(one / "critical.csv") for one in (base, changed))
            options = (changed / "options.txt").read_text()
        self.assertIn("-material_lining_young 1515000000", options)
        self.assertRegex(options, r"-material_disc_density 7192\.8")
        self.assertEqual(len(before), len(after))
        printed = re.findall(
            r"^  coalescence, (\S+) Hz +(\S+) +(\S+) +(\S+)  (as predicted|not linear)$",
            run.stdout,
            re.M,
        )
        self.assertEqual(len(printed), len(before))
        self.assertGreater(len(printed), 1)
        for (_, friction, prediction, change, verdict), one, other in zip(printed, before, after):
            wanted = sum(
                float(row["friction_derivative"]) * more
                for row in derivatives
                for parameter, more in (("young_lining", 0.01), ("density_disc", -0.001))
                if row["friction"] == one["friction"] and row["parameter"] == parameter
            )
            came = float(other["friction"]) - float(one["friction"])
            self.assertAlmostEqual(float(friction), float(one["friction"]), delta=1e-9)
            self.assertAlmostEqual(float(prediction), wanted, delta=1e-3 * abs(wanted))
            self.assertAlmostEqual(float(change), came, delta=1e-3 * abs(came))
            self.assertEqual(verdict == "as predicted", abs(came - wanted) <= 0.02 * abs(came))

    def test_words_are_checked_before_the_run(self):
        for word, reason in (
            ("lining.young", "it has the form NAME.QUANTITY=FACTOR"),
            ("lining.young=1", "with a factor > 0 that is not 1"),
            ("lining.young=-2", "with a factor > 0 that is not 1"),
            ("lining.young=x", "with a factor > 0 that is not 1"),
            ("young=1.1", "young is the quantity of a body, spring, bushing or mass"),
        ):
            with tempfile.TemporaryDirectory() as folder:
                run = squeal_run(folder, "layer", "-what_if", word)
                self.assertEqual(list(Path(folder).iterdir()), [])
            self.assertEqual(run.returncode, 1)
            self.assertIn(f"squeal-run: -what_if {word}: ", run.stderr)
            self.assertIn(reason, run.stderr)
        run = squeal_run("/", "layer", "-dry_run", "-what_if", "disc.young=1.1")
        self.assertEqual(run.returncode, 1)
        self.assertIn("-what_if needs results", run.stderr)


class Options(unittest.TestCase):
    """Which options a word changes, and how; the run is made up."""

    def options(self, given, parameters, *words):
        table = pd.DataFrame({"parameter": parameters})
        with tempfile.TemporaryDirectory() as folder:
            text = "".join(f"-{name} {value}\n" for name, value in given.items())
            (Path(folder) / "options.txt").write_text("# head\n" + text)
            run = SimpleNamespace(
                folder=Path(folder), sensitivities=table, critical_sensitivities=None
            )
            found = what_if.options_of(run, what_if.changes_of(words))
        return {name: [float(x) for x in re.split("[:,]", value)] for name, value in found}

    def test_moduli_of_orthotropic_bodies(self):
        given = {"material_pad_engineering_constants": "2e9,3e9,1.5e9,0.2,0.1,0.15,1e9,8e8,7e8"}
        found = self.options(given, ["young_pad"], "pad.young=2")
        self.assertEqual(
            found["material_pad_engineering_constants"],
            [4e9, 6e9, 3e9, 0.2, 0.1, 0.15, 2e9, 1.6e9, 1.4e9],
        )
        given = {"material_pad_transverse": "2e9,1e9,0.3,0.1,5e8"}
        found = self.options(given, ["young_pad"], "pad.young=2")
        self.assertEqual(found["material_pad_transverse"], [4e9, 2e9, 0.3, 0.1, 1e9])

    def test_springs_bushings_masses_and_damping(self):
        given = {
            "spring_a_stiffness": "1e6",
            "bushing_b_stiffness": "1,2,3",
            "mass_hub_total": "2",
            "mass_hub_inertia": "1,1,2,0,0,0",
            "material_pad_rayleigh_mass": "3",
            "material_pad_loss_factor": "0.1",
            "material_pad_loss_frequency": "6000",
        }
        parameters = [
            "spring_a_stiffness",
            "bushing_b_stiffness",
            "mass_hub",
            "damping_pad",
        ]
        found = self.options(
            given, parameters, "a.stiffness=2", "b.stiffness=3", "hub.mass=2", "pad.damping=0.5"
        )
        self.assertEqual(
            found,
            {
                "spring_a_stiffness": [2e6],
                "bushing_b_stiffness": [3, 6, 9],
                "mass_hub_total": [4],
                "mass_hub_inertia": [2, 2, 4, 0, 0, 0],
                "material_pad_rayleigh_mass": [1.5],
                "material_pad_loss_factor": [0.05],
            },
        )

    def test_sweeps(self):
        given = {"flutter_speed": "1:3:0.5", "flutter_pressure": "1,2"}
        found = self.options(given, ["speed", "pressure"], "speed=2", "pressure=1.5")
        self.assertEqual(found, {"flutter_speed": [2, 6, 1], "flutter_pressure": [1.5, 3]})

    def test_names_that_do_not_exist(self):
        with self.assertRaisesRegex(ResultsError, "no derivative of young of plate; .* pad.young"):
            self.options({}, ["young_pad", "friction"], "plate.young=1.1")
        with self.assertRaisesRegex(ResultsError, "names a quantity twice"):
            what_if.changes_of(["pad.young=1.1", "pad.young=1.2"])
        with self.assertRaisesRegex(ResultsError, "no option of the run gives this value"):
            self.options({}, ["young_section"], "section.young=1.1")

    def test_a_line_without_a_partner_has_no_verdict(self):
        line = what_if.Line("mode 1", 1.0, 0.1, math.nan, 0.0)
        self.assertEqual(line.verdict(), "not found, or not solved for, in the changed run")


if __name__ == "__main__":
    unittest.main()
