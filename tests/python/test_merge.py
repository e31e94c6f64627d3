#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The merge of runs over parts of one grid, on runs made here: test_merge.py PROGRAM."""
import functools
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
import pandas as pd

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/harness")]
sys.dont_write_bytecode = True
import squeal
import squeal.merge
from squeal.parts import Part
from squeal.report import build, certificate, verdict
from squeal.tables import read_table
from changed_tables import reshape

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")
PARAMETERS = list(squeal.PARAMETERS)


def text_of(path):
    return pd.read_csv(path, dtype=str, keep_default_na=False)


class Merge(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.made = Path(temporary.name)
        layers = [
            "two_layers_moving",
            "-mesh_set",
            "nx=6,ny_disc=2,ny_pad=2,order=2",
            "-modes_count",
            "40",
            "-flutter_friction",
            "0,0.2,0.4",
            "-flutter_track",
            "on",
        ]
        chain = ["external_chain", "-flutter_friction"]
        for folder, (case, *words) in {
            "layers": [*layers, "-flutter_speed", "1,2"],
            "layers_1": layers,
            "layers_2": [*layers, "-flutter_speed", "2"],
            "chain": [*chain, "0:1.2:0.2"],
            "chain_low": [*chain, "0:1:0.2"],
            "chain_high": [*chain, "1:1.2:0.2"],
            "chain_damped": [*chain, "0:1.2:0.2", "-flutter_damping", "2"],
            "chain_band": [*chain, "1.6", "-flutter_band", "0.5"],
        }.items():
            subprocess.run(
                [
                    PROGRAM,
                    "-options_file",
                    repository / f"options/{case}.yaml",
                    "-report_dir",
                    cls.made / folder,
                    "-quiet",
                    *words,
                ],
                check=True,
                stdout=subprocess.DEVNULL,
            )

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.out = self.folder / "out"

    def copy(self, name, **texts):
        """A copy of a run in which the texts of files, by their names with _ for the dot, are
        changed by functions."""
        copy = self.folder / f"{name}_{len(list(self.folder.iterdir()))}"
        shutil.copytree(self.made / name, copy, ignore=shutil.ignore_patterns("vtk"))
        for file, change in texts.items():
            path = copy / ".".join(file.rsplit("_", 1))
            before = path.read_text()
            path.write_text(change(before))
            self.assertNotEqual(path.read_text(), before)
        return copy

    def merge(self, *names, out=None):
        return squeal.merge.merge(out or self.out, [self.made / name for name in names])

    def refused(self, pattern, *names, call=None):
        with self.assertRaisesRegex(squeal.ResultsError, pattern) as caught:
            (call or self.merge)(*names)
        self.assertNotIn("\n", str(caught.exception))
        self.assertEqual([path.name for path in self.folder.glob(".*")], [])

    # --- what is joined ---

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
        for name in ("eigenvalues", "stability_map", "friction_work"):
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

    # --- what is refused ---

    def test_other_options(self):
        self.refused(
            (
                r"chain_band is not part of the same grid as .*chain:"
                r" -flutter_band differs, 0.5 and"
                r" 0; see --variants"
            ),
            "chain",
            "chain_band",
        )
        same = self.copy(
            "chain_damped",
            options_txt=lambda text: text.replace(
                "# -flutter_tolerance 1e-08", "-flutter_tolerance 0.01e-6"
            ),
        )
        squeal.merge.merge(self.out, [self.made / "chain", same])
        more = self.copy(
            "chain_damped", options_txt=lambda text: text + "-flutter_st_type sinvert\n"
        )
        self.refused("-flutter_st_type differs, sinvert and none", self.made / "chain", more)
        # By default, and by one run alone
        asked = self.copy(
            "chain_damped", options_txt=lambda text: text + "# -flutter_unheard_of 1\n"
        )
        squeal.merge.merge(self.out, [self.made / "chain", asked])
        changed_run = self.copy(
            "chain_damped",
            options_txt=lambda text: text.replace("# -report_frames 16", "-report_frames 8")
            + "-resume on\n-log_view\n",
        )
        squeal.merge.merge(self.out, [self.made / "chain", changed_run])
        other = self.copy(
            "chain_damped", summary_json=lambda text: text.replace('"version": "', '"version": "9')
        )
        self.refused("the version of the program differs, 9", self.made / "chain", other)

    def test_other_meshes(self):
        moved = self.copy("layers_2")
        with h5py.File(moved / "results.h5", "r+") as file:
            file["mesh/coordinates"][3, 0] += 1e-6
        self.refused("the meshes differ, nodes up to 1e-06 apart", self.made / "layers_1", moved)
        # The numbers of the nodes follow the ranks, and the file may lie elsewhere.
        turned = self.copy(
            "layers_2",
            options_txt=lambda text: text.replace("-mesh_file ", "-mesh_file /elsewhere"),
        )
        with h5py.File(turned / "results.h5", "r+") as file:
            file["mesh/coordinates"][...] = file["mesh/coordinates"][...][::-1]
        squeal.merge.merge(self.out, [self.made / "layers_1", turned])
        fewer = self.copy(
            "layers_2",
            summary_json=lambda text: text.replace('"contact_nodes": ', '"contact_nodes": 1'),
        )
        self.refused("the meshes differ in contact_nodes", self.made / "layers_1", fewer)

    def test_other_numbers_at_one_point(self):
        def change(factor):
            def of(text):
                head, *rows = text.splitlines()
                rows = [row.split(",") for row in rows]
                at, error = head.split(",").index("angular_frequency_rad_per_s"), head.split(
                    ","
                ).index("error_estimate")
                for row in rows:
                    row[at], row[error] = f"{float(row[at]) * factor:.15e}", "1e-12"
                return "\n".join([head, *(",".join(row) for row in rows)]) + "\n"

            return of

        near, far = (
            self.copy("chain_high", eigenvalues_csv=change(1 + by)) for by in (3e-10, 3e-9)
        )
        exact = self.copy("chain_high", eigenvalues_csv=change(1))
        squeal.merge.merge(self.out, [exact, near])
        self.refused(
            "have different results at friction 1: mode [0-9]+ is .* and .* 1/s", exact, far
        )

        def undecided(text):
            summary = json.loads(text)
            for point in summary["frictions"]:
                point["verdict"] = "undecided" if point["verdict"] == "stable" else point["verdict"]
                point["verdicts"]["undecided"], point["verdicts"]["stable"] = (
                    point["verdicts"]["undecided"] + point["verdicts"]["stable"],
                    0,
                )
            return json.dumps(summary)

        words = {
            name: lambda text: re.sub(r"\bstable\b", "undecided", text)
            for name in ("eigenvalues_csv",)
        }
        verdict = self.copy("chain_high", **words, summary_json=undecided)
        self.refused(
            "have different results at friction .*[(]stable[)] and .*[(]undecided[)]",
            self.made / "chain_high",
            verdict,
        )

        def fewer(text):
            summary = json.loads(text)
            summary["frictions"][-1]["eigenvalues"] -= 1
            summary["frictions"][-1]["verdicts"]["stable"] -= 1
            return json.dumps(summary)

        shorter = self.copy(
            "chain_high",
            eigenvalues_csv=lambda text: text.rsplit("\n", 2)[0] + "\n",
            summary_json=fewer,
        )
        reshape(shorter)
        self.refused(
            "have different results at friction 1.2: [0-9]+ and [0-9]+ eigenvalues",
            self.made / "chain_high",
            shorter,
        )

    def test_incomplete_parts(self):
        self.refused("holds no complete results: there is no summary.json", "chain", "nowhere")
        cut = self.copy(
            "chain_damped",
            summary_json=lambda text: json.dumps({**json.loads(text), "complete": False}),
        )
        self.refused("holds no complete results: its run was interrupted", self.made / "chain", cut)
        bare = self.copy("chain_damped")
        (bare / "eigenvalues.csv").unlink()
        self.refused("eigenvalues.csv is missing", self.made / "chain", bare)
        self.merge("chain", "chain_damped")
        self.refused("is a merge itself", self.out, "chain")
        self.refused("is named twice", "chain", "chain")
        self.assertEqual(len(squeal.open(self.out).points), 14)

    def test_cut_tables(self):
        """A table of which the end is lost: within its last number, within its last row, by rows,
        or by a field of some row."""
        ends = {
            "within the last field": (lambda text: text[:-3], "line [0-9]+ is cut"),
            "without the end of the last line": (lambda text: text[:-1], "line [0-9]+ is cut"),
            "within the last row": (
                lambda text: text[: text.rindex(",")] + "\n",
                "line [0-9]+ is cut",
            ),
            "within a row": (
                lambda text: "\n".join(
                    row.rpartition(",")[0] if n == 2 else row
                    for n, row in enumerate(text.split("\n"))
                ),
                "line 3 is cut",
            ),
            "by a row": (
                lambda text: text[:-1].rpartition("\n")[0] + "\n",
                r"is cut: it has [0-9]+ rows.*, summary.json lists [0-9]+",
            ),
            "by all rows": (
                lambda text: text.partition("\n")[0] + "\n",
                r"is cut: it has 0 rows.*, summary.json lists [0-9]+",
            ),
        }
        for table in ("eigenvalues", "stability_map", "critical"):
            for where, (change, message) in ends.items():
                with self.subTest(table=table, where=where):
                    cut = self.copy("chain_high", **{f"{table}_csv": change})
                    self.refused(f"{cut}/{table}.csv:? {message}", self.made / "chain_low", cut)
        self.assertFalse(self.out.exists())

    def test_summaries_of_no_run(self):
        """Whatever value of summary.json is lost or is of another kind, it is named, or not read;
        nothing is written."""

        def parts_of(value, place=()):
            inside = (
                value.items()
                if isinstance(value, dict)
                else enumerate(value[:1])
                if isinstance(value, list)
                else ()
            )
            for name, entry in inside:
                yield (*place, name)
                yield from parts_of(entry, (*place, name))

        def changed(place, *new):
            summary = json.loads(whole)
            holder = functools.reduce(lambda value, name: value[name], place[:-1], summary)
            holder.pop(place[-1])
            if new:
                (
                    holder.insert(*place[-1:], *new)
                    if isinstance(holder, list)
                    else holder.update({place[-1]: new[0]})
                )
            return json.dumps(summary)

        damaged = self.copy("chain_high")
        whole = (damaged / "summary.json").read_text()
        for text, message in (
            ("[1, 2]", "it is not an object"),
            ("{}", "`version` is missing"),
            (changed(("complete",), 1), "`complete` is not true or false"),
            (changed(("frictions", 0), 7), r"`frictions\[0\]` is not an object"),
            (changed(("frictions", 0, "friction")), r"`frictions\[0\].friction` is missing"),
            (
                changed(("frictions", 0, "friction"), True),
                r"`frictions\[0\].friction` is not a number",
            ),
            (
                changed(("frictions", 0, "eigenvalues"), "10"),
                r"`frictions\[0\].eigenvalues` is not a whole number",
            ),
            (
                changed(("active_sets", 0, "followed", 0, "critical_frictions"), None),
                r"`active_sets\[0\].followed\[0\].critical_frictions` is not a list",
            ),
            (changed(("stages", "flutter"), 7), "`stages.flutter` is not an object"),
        ):
            with self.subTest(message):
                (damaged / "summary.json").write_text(text)
                self.refused(
                    f"{damaged}/summary.json is not a summary of a run: {message}", "chain", damaged
                )
        (damaged / "summary.json").write_text(whole[:100])
        self.refused(f"{damaged}/summary.json: ", "chain", damaged)
        self.assertFalse(self.out.exists())
        said, tables = 0, {}

        def read_once(path, shape=None):
            """The tables stay as they are."""
            key = path, json.dumps(shape)
            if key not in tables:
                tables[key] = read_table(path, shape)
            return tables[key]

        for place in (place for place in parts_of(json.loads(whole)) if place[:-1] != ("options",)):
            for new in ((), (["x"],)):
                (damaged / "summary.json").write_text(changed(place, *new))
                try:
                    with mock.patch("squeal.results.read_table", read_once):
                        read = squeal.open(damaged)
                        Part(damaged)
                    verdict(read), certificate(read)
                except squeal.ResultsError as error:
                    self.assertRegex(str(error), f"^[^\n]*{damaged}[^\n]*$")
                    said += 1
        self.assertGreater(said, 20)

    def test_out_inside_a_part(self):
        run = self.copy("chain")
        before = sorted(run.rglob("*"))
        (self.folder / "link").symlink_to(run)
        for out in (
            run / "out",
            run / "deep" / "out",
            self.folder / "link" / "out",
            self.folder / "other" / ".." / run.name / "out",
        ):
            for join in (squeal.merge.merge, squeal.merge.list_variants):
                self.refused(
                    "out is inside .*chain_0, one of its parts: name a folder outside",
                    call=lambda: join(out, [run, self.made / "chain_damped"]),
                )
        self.assertEqual(sorted(run.rglob("*")), before)

    def test_folders_that_are_no_merge_stay(self):
        self.out.mkdir()
        (self.out / "mine.txt").write_text("mine")
        self.refused("exists and is not a merge", "chain", "chain_damped")
        for text in ("7", '["parts"]', '{"parts": []}'):
            (self.out / "summary.json").write_text(text)
            (self.out / "manifest.txt").write_text(
                "# squeal\nmanifest.txt\nmine.txt\nsummary.json\n"
            )
            self.refused("exists and is not a merge", "chain", "chain_damped")
        for name in ("summary.json", "manifest.txt"):
            (self.out / name).unlink()
        run = self.copy("chain")
        self.refused(
            "exists and is not a merge",
            call=lambda: squeal.merge.merge(run, [self.made / "chain", self.made / "chain_damped"]),
        )
        self.assertTrue((run / "options.txt").exists())
        (self.out / "mine.txt").unlink()
        self.out.rmdir()
        self.merge("chain", "chain_damped")
        (self.out / "mine.txt").write_text("mine")
        self.refused("holds mine.txt, which no merge has written", "chain", "chain_damped")
        self.assertEqual((self.out / "mine.txt").read_text(), "mine")

    def test_appears_whole_or_not_at_all(self):
        self.merge("chain", "chain_damped")
        before = (self.out / "eigenvalues.csv").read_text()
        with mock.patch.object(
            squeal.merge, "_write_summary", side_effect=OSError(28, "No space left on device")
        ):
            self.refused("cannot write .*out: No space left on device", "chain_low", "chain_damped")
            self.refused(
                "cannot write .*new: No space left",
                call=lambda: self.merge("chain_low", "chain_damped", out=self.folder / "new"),
            )
        self.assertEqual((self.out / "eigenvalues.csv").read_text(), before)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["out"])

    # --- variants, and the command ---

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
