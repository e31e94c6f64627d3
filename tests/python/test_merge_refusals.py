#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""What a merge refuses: other options, meshes and numbers, incomplete and damaged runs, and folders
that it must not write to. test_merge_refusals.py PROGRAM PARTS, with the runs of grid_parts.py."""
import functools
import json
import re
import sys
import unittest
from pathlib import Path
from unittest import mock

import h5py

repository = Path(__file__).resolve().parents[2]
folders = ("python", "tests/support/harness", "tests/support/run")
sys.path[:0] = [str(repository / folder) for folder in folders]
sys.dont_write_bytecode = True
import squeal
import squeal.merge
from changed_tables import reshape
from grid_parts import OnParts
from squeal.parts import Part
from squeal.report import certificate, verdict
from squeal.tables import read_table


class Refusals(OnParts):
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


if __name__ == "__main__":
    unittest.main(verbosity=2)
