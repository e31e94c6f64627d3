#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The merge of runs over parts of one grid: test_merge.py PROGRAM PARTS, with the runs of
grid_parts.py."""
import json
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np
import pandas as pd

repository = Path(__file__).resolve().parents[2]
folders = ("python", "tests/support/harness", "tests/support/run")
sys.path[:0] = [str(repository / folder) for folder in folders]
sys.dont_write_bytecode = True
import squeal
import squeal.merge
from changed_tables import reshape
from grid_parts import OnParts
from squeal.report import build

PARAMETERS = list(squeal.PARAMETERS)


def text_of(path):
    return pd.read_csv(path, dtype=str, keep_default_na=False)


class Merge(OnParts):
    def test_is_the_run_over_the_whole_grid(self):
        """Two runs correct their bases by other vectors: each eigenvalue is known to its estimated
        error."""
        self.merge("layers_2", "layers_1")
        merged, whole = squeal.open(self.out), squeal.open(self.made / "layers")
        self.assertEqual(merged.points.to_numpy().tolist(), whole.points.to_numpy().tolist())
        self.assertEqual(merged.swept(), ["friction", "speed"])
        one, other = merged.eigenvalues, whole.eigenvalues
        self.assertEqual(
            one[[*PARAMETERS, "mode", "verdict"]].to_numpy().tolist(),
            other[[*PARAMETERS, "mode", "verdict"]].to_numpy().tolist(),
        )
        apart = np.abs(one["s"] - other["s"]) / np.abs(other["s"])
        self.assertTrue((apart <= 1e-12 + one["error_estimate"] + other["error_estimate"]).all())
        self.assertEqual(len(merged.branches), len(whole.branches))
        self.assertEqual(len(merged.critical), len(whole.critical))
        self.assertGreater(len(merged.critical), 0)
        self.assertEqual(set(merged.branches["active_set"]), {1, 2})  # one of each part

    def test_rows_are_those_of_the_parts_letter_by_letter(self):
        self.merge("layers_2", "layers_1")
        shares = ("components", "participation", "participation_bodies")
        for name in ("eigenvalues", "stability_map", "friction_work", *shares):
            parts = pd.concat(
                [text_of(self.made / part / f"{name}.csv") for part in ("layers_1", "layers_2")],
                ignore_index=True,
            )
            pd.testing.assert_frame_equal(text_of(self.out / f"{name}.csv"), parts)

    def test_summary(self):
        self.merge("layers_2", "layers_1")
        summary, parts = json.loads((self.out / "summary.json").read_text()), [
            squeal.open(self.made / f"layers_{n}").summary for n in (2, 1)
        ]
        self.assertIs(summary["complete"], True)
        self.assertEqual(
            [(entry["friction"], entry["speed"], entry["part"]) for entry in summary["frictions"]],
            [(0, 1, 2), (0.2, 1, 2), (0.4, 1, 2), (0, 2, 1), (0.2, 2, 1), (0.4, 2, 1)],
        )
        self.assertEqual(
            [entry["verdict"] for entry in summary["frictions"][3:]],
            [entry["verdict"] for entry in parts[0]["frictions"]],
        )
        self.assertEqual(
            [part["stages"] for part in summary["parts"]], [part["stages"] for part in parts]
        )
        self.assertEqual(
            [(self.out / part["recipe"]).resolve() for part in summary["parts"]],
            [(self.made / f"layers_{n}" / "options.txt").resolve() for n in (2, 1)],
        )
        self.assertEqual(summary["options"]["flutter_speed"], "1,2")
        self.assertEqual(summary["wall_s"], sum(part["wall_s"] for part in parts))

    def test_points_that_are_missing_in_the_grid_are_counted(self):
        said = self.merge("chain_low", "chain_damped")
        self.assertIn("13 of the 14 points of the grid of all values are there", said)
        # On a map, one damping of another pressure may be all that is there.
        pressed = self.copy(
            "chain_damped",
            summary_json=lambda text: text.replace('"pressure": 1.0', '"pressure": 2.0'),
        )
        for name in ("eigenvalues", "stability_map", "branches", "critical"):
            table = pd.read_csv(pressed / f"{name}.csv", dtype=str, keep_default_na=False)
            table.assign(pressure="2").to_csv(pressed / f"{name}.csv", index=False)
        squeal.merge.merge(self.out, [self.made / "chain_low", self.made / "chain_damped", pressed])
        subprocess.run([repository / "scripts/squeal-plot", self.out], check=True)

    def test_branches_of_one_line_keep_numbers_of_their_own(self):
        said = self.merge("chain_low", "chain_high")
        low, high, merged = (
            squeal.open(folder)
            for folder in (self.made / "chain_low", self.made / "chain_high", self.out)
        )
        most = low.branches["branch"].max()
        self.assertEqual(
            sorted(merged.branches["branch"].unique()),
            list(range(1, most + high.branches["branch"].max() + 1)),
        )
        self.assertEqual(len(merged.branches), len(low.branches) + len(high.branches))
        self.assertEqual(set(merged.branches["active_set"]), {1, 2})
        # The point 1 is in both, and so are the critical frictions below it: each run follows from
        # friction 0.
        self.assertEqual(sum("the point friction 1 is in" in line for line in said), 1)
        self.assertEqual(len(merged.points), 7)
        whole = squeal.open(self.made / "chain").critical
        self.assertGreater(len(low.critical), 0)
        np.testing.assert_allclose(merged.critical["friction"], whole["friction"], rtol=1e-7)
        new = merged.critical[merged.critical["active_set"] == 2]
        self.assertGreater(len(new), 0)
        self.assertTrue((new["branch"] > most).all())
        self.assertTrue(((new["partner"] > most) | (new["partner"] <= 0)).all())

    def test_derivatives_follow_their_critical_frictions(self):
        """chain_high finds the critical frictions of chain_low again, and one more."""
        self.merge("chain_low", "chain_high")
        keys = ["active_set", "branch", "partner", "kind", "direction", *PARAMETERS]
        merged = text_of(self.out / "critical_sensitivities.csv")
        criticals = text_of(self.out / "critical.csv")
        self.assertEqual(
            merged[keys].drop_duplicates().to_numpy().tolist(), criticals[keys].to_numpy().tolist()
        )
        self.assertEqual(set(criticals["active_set"]), {"1", "2"})
        low, high = (
            text_of(self.made / part / "critical_sensitivities.csv")
            for part in ("chain_low", "chain_high")
        )
        fresh = high[high["friction"].astype(float) > 1]
        self.assertGreater(len(fresh), 0)
        values = [name for name in merged if name not in ("active_set", "branch", "partner")]
        self.assertEqual(
            merged[values].to_numpy().tolist(),
            [*low[values].to_numpy().tolist(), *fresh[values].to_numpy().tolist()],
        )

    def test_every_table_is_merged_or_named(self):
        for parts in (("layers_2", "layers_1"), ("chain_low", "chain_high")):
            said = self.merge(*parts)
            named = [line for line in said if "stay in the parts and are not merged: " in line]
            left = named[0].partition("merged: ")[2].split(", ")
            self.assertIn("modes.csv", left)
            written = {path.name for part in parts for path in (self.made / part).glob("*.csv")}
            for name in written:
                joined = (self.out / name).exists()
                kinds = {name, name.partition("_")[0] + "_*.csv"}
                self.assertEqual(len(kinds & set(left)), 0 if joined else 1, name)
            summary = json.loads((self.out / "summary.json").read_text())
            self.assertEqual(sorted({"results.h5", *left}), sorted(summary["not_merged"]))

    def test_tables_that_only_some_parts_have_are_named(self):
        without = self.copy("layers_2")
        (without / "friction_work.csv").unlink()
        # Its run has written it
        self.refused("friction_work.csv is missing", self.made / "layers_1", without)
        reshape(without, without=["friction_work"])
        said = squeal.merge.merge(self.out, [self.made / "layers_1", without])
        self.assertTrue(
            any(
                line.startswith("friction_work.csv is not merged") and str(without) in line
                for line in said
            ),
            said,
        )
        self.assertFalse((self.out / "friction_work.csv").exists())
        self.assertIn(
            "friction_work.csv", json.loads((self.out / "summary.json").read_text())["not_merged"]
        )

    def test_is_plotted_and_reported(self):
        self.merge("layers_1", "layers_2")
        subprocess.run([repository / "scripts/squeal-plot", self.out], check=True)
        listed = (self.out / "manifest.txt").read_text().splitlines()
        self.assertTrue(
            {"stability_speed_1.png", "stability_speed_2.png", "stability_map.png"} <= set(listed),
            listed,
        )
        self.assertIn(f"the {len(listed) - 1} files", listed[0])
        run = squeal.open(self.out)
        text = build(run)
        self.assertIn("Shapes of modes and contact fields are in the reports of each", text)
        self.assertIn("layers_2", text)
        self.assertTrue(run.kept_modes().empty)
        self.assertEqual(
            [part.resolve() for part in run.parts],
            [(self.made / f"layers_{n}").resolve() for n in (1, 2)],
        )
        with self.assertRaisesRegex(
            squeal.ResultsError, "is a merge: modes and fields are in its parts"
        ):
            run.mode(1, friction=0.4, speed=1)
        self.merge("layers_1", "layers_2")  # an earlier merge is replaced, with its plots
        self.assertFalse((self.out / "stability_map.png").exists())

    def test_variants(self):
        names = ("chain", "chain_damped", "chain_band")
        squeal.merge.list_variants(self.out, [self.made / name for name in names])
        table = pd.read_csv(self.out / "variants.csv")
        runs = [squeal.open(self.made / name) for name in names]
        self.assertEqual(
            list(table.columns[:4]), ["part", "flutter_band", "flutter_damping", "flutter_friction"]
        )
        self.assertEqual(table["flutter_damping"].tolist(), [1, 2, 1])
        self.assertEqual(table["flutter_friction"].tolist(), ["0:1.2:0.2", "0:1.2:0.2", "1.6"])
        self.assertEqual(
            table["worst_growth_rate_1_per_s"].tolist(),
            [run.stability_map["largest_growth_rate_1_per_s"].max() for run in runs],
        )
        lost = runs[0].critical.query("direction == 'loss'")["friction"].min()
        self.assertEqual(table["critical_friction"][0], lost)
        self.assertEqual(
            table["verdict"].tolist(),
            [
                "unstable" if (run.stability_map["unstable_modes"] > 0).any() else "stable"
                for run in runs
            ],
        )
        self.assertEqual(
            table["unstable_points"].tolist(),
            [int((run.stability_map["unstable_modes"] > 0).sum()) for run in runs],
        )

    def test_command(self):
        command = [repository / "scripts/squeal-merge", self.out, self.made / "chain"]
        done = subprocess.run(
            [*command, self.made / "chain_damped"], capture_output=True, text=True
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("14 points of 2 parts", done.stdout)
        failed = subprocess.run(
            [*command, self.made / "chain_band"], capture_output=True, text=True
        )
        self.assertEqual((failed.returncode, len(failed.stderr.splitlines())), (1, 1))
        self.assertTrue(failed.stderr.startswith("squeal-merge: "))
        listed = self.copy("chain", summary_json=lambda _: "[]")
        failed = subprocess.run(
            [repository / "scripts/squeal-merge", self.folder / "new", listed],
            capture_output=True,
            text=True,
        )
        self.assertEqual(
            (failed.returncode, failed.stderr),
            (
                1,
                f"squeal-merge: {listed}/summary.json is not a summary of a run:"
                " it is not an object\n",
            ),
        )
        self.assertFalse((self.folder / "new").exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
