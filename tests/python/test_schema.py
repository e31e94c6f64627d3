#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Tables of runs against their schema, and the message for each kind of damage: test_schema.py
PROGRAM TABLES RESULTS, with the results of all_tables.py and of after_flutter.py."""
import json
import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / folder) for folder in ("python", "tests/support/run")]
sys.dont_write_bytecode = True
import squeal
from all_tables import OnTables, cells_of, text_of
from squeal import schema


class Schema(OnTables):
    def test_the_program_writes_what_the_schema_says(self):
        """Column by column, in every table; and every table of the schema is among them."""
        seen = set()
        for name, run in self.runs.items():
            for path in (self.place / name).glob("*.csv"):
                with self.subTest(run=name, table=path.stem):
                    table = schema.schema_of(path.stem)
                    header = cells_of(path.read_text())[0]
                    self.assertIsNotNone(table)
                    self.assertEqual(
                        [column for column in header if table.column(column) is None], []
                    )
                    self.assertEqual(
                        {column.name for column in table.columns if "{}" not in column.name}
                        - set(header),
                        set(),
                    )
                    self.assertIn(path.stem, run.summary["tables"])
                    seen |= {kind for kind, one in schema.TABLES.items() if one is table}
        self.assertEqual(seen, set(schema.TABLES))

    def test_units_are_those_of_the_names(self):
        for kind, table in schema.TABLES.items():
            for column in table.columns:
                self.assertTrue(
                    column.unit == ""
                    or any(
                        column.name.endswith(end) and column.unit == unit
                        for end, unit in schema.UNITS.items()
                    ),
                    (kind, column),
                )
        self.assertEqual(
            schema.TABLES["regime_spectrum"].column("velocity_2_normal_m_per_s").unit, "m/s"
        )
        self.assertIsNone(schema.TABLES["regime_spectrum"].column("velocity_0_normal_m_per_s"))

    def refused(self, run, name, change, message):
        """A change of the text of a table is refused when the results are opened, by this
        message."""
        path = self.place / run / f"{name}.csv"
        before = path.read_text()
        self.addCleanup(path.write_text, before)
        path.write_text(change(before))
        self.assertNotEqual(path.read_text(), before)
        with self.assertRaisesRegex(squeal.ResultsError, message) as caught:
            squeal.open(self.place / run)
        self.assertIn(str(path), str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))
        path.write_text(before)

    def change_cell(self, row, column, value):
        def change(text):
            rows = cells_of(text)
            rows[row][rows[0].index(column)] = value
            return text_of(rows)

        return change

    def test_messages_name_file_line_column_and_rule(self):
        words = "unstable, undecided, uncertified, stable, neutral"
        for run, name, change, message in (
            (
                "chain",
                "eigenvalues",
                self.change_cell(3, "verdict", "wobbly"),
                f"line 4, column verdict: 'wobbly' is none of the words {words}",
            ),
            (
                "chain",
                "eigenvalues",
                self.change_cell(3, "growth_rate_1_per_s", "nan"),
                "line 4, column growth_rate_1_per_s in 1/s: 'nan' is not a number",
            ),
            (
                "chain",
                "eigenvalues",
                self.change_cell(3, "growth_rate_1_per_s", ""),
                "line 4, column growth_rate_1_per_s in 1/s: '' is not a number",
            ),
            (
                "chain",
                "eigenvalues",
                self.change_cell(3, "frequency_hz", "1e999"),
                "line 4, column frequency_hz in Hz: '1e999' is beyond the largest number",
            ),
            (
                "chain",
                "eigenvalues",
                self.change_cell(3, "mode", "0"),
                "line 4, column mode: '0' is below 1",
            ),
            (
                "chain",
                "eigenvalues",
                self.change_cell(3, "mode", "1.5"),
                "line 4, column mode: '1.5' is not a whole number",
            ),
            (
                "chain",
                "eigenvalues",
                self.change_cell(3, "certified", "2"),
                "line 4, column certified: '2' is not 0 or 1",
            ),
            (
                "chain",
                "eigenvalues",
                self.change_cell(0, "certified", "sure"),
                "there is no column certified, which the run has written",
            ),
            (
                "brake",
                "regime",
                self.change_cell(1, "class", "serene"),
                "line 2, column class: 'serene' is none of the words growing, steady, periodic",
            ),
            (
                "brake",
                "regime_cycles",
                lambda text: "".join(text.splitlines(True)[: len(text.splitlines()) // 2]),
                r"is cut: it has \d+ rows, summary.json lists \d+",
            ),
            ("brake", "regime_cycles", lambda text: text[: len(text) // 2], r"line \d+ is cut"),
            ("chain", "eigenvalues", lambda text: text + "x\0,\n", r"line \d+ is cut|NUL"),
        ):
            with self.subTest(run=run, table=name, message=message):
                self.refused(run, name, change, message)

    def test_words_that_contradict_the_summary(self):
        """A word of a table in the place of another of its words."""
        rows = cells_of((self.place / "layers/eigenvalues.csv").read_text())
        verdicts = [row[rows[0].index("verdict")] for row in rows]
        at = verdicts.index("unstable")
        self.refused(
            "layers",
            "eigenvalues",
            self.change_cell(at, "verdict", "undecided"),
            "eigenvalues that are .*, summary.json lists",
        )
        self.refused(
            "layers",
            "stability_map",
            self.change_cell(1, "unstable_modes", "7"),
            "7 unstable modes at friction 0, .*, summary.json lists ",
        )
        for run in ("layers", "belt"):  # at friction 0, and beyond
            self.refused(
                run,
                "critical",
                self.change_cell(1, "direction", "regain"),
                "line 2: regain of stability, with the slope",
            )
        self.refused(
            "brake",
            "regime",
            self.change_cell(1, "class", "steady"),
            "is steady, summary.json lists",
        )
        self.refused(
            "judged",
            "referee",
            self.change_cell(1, "verdict", "double"),
            "entries that are .*, summary.json lists",
        )

    def test_results_of_versions_without_shapes(self):
        """What a program here reads has to be there; other columns need not be."""
        copy = self.place / "former"
        shutil.copytree(self.place / "chain", copy)
        summary = json.loads((copy / "summary.json").read_text())
        del summary["tables"]
        (copy / "summary.json").write_text(json.dumps(summary))
        for column, message in (
            ("verdict", "there is no column verdict"),
            ("backward_error", None),
        ):
            rows = cells_of((self.place / "chain/eigenvalues.csv").read_text())
            at = rows[0].index(column)
            (copy / "eigenvalues.csv").write_text(
                text_of([row[:at] + row[at + 1 :] for row in rows])
            )
            if message is None:
                self.assertEqual(len(squeal.open(copy).eigenvalues), len(rows) - 1)
            else:
                with self.assertRaisesRegex(squeal.ResultsError, message):
                    squeal.open(copy)

    def test_what_is_no_regular_file(self):
        """Links, pipes and folders are named, and nothing waits; in every file that is read."""
        foreign = self.place / "foreign"
        for name in ("summary.json", "eigenvalues.csv", "stability_map.csv"):
            for kind, plant in (
                ("a link", lambda path: path.symlink_to(foreign)),
                ("a named pipe", os.mkfifo),
                ("a folder", os.mkdir),
            ):
                with self.subTest(name=name, kind=kind):
                    copy = self.place / "planted"
                    shutil.copytree(self.place / "chain", copy)
                    self.addCleanup(shutil.rmtree, copy, ignore_errors=True)
                    (copy / name).rename(foreign)
                    plant(copy / name)
                    with self.assertRaisesRegex(
                        squeal.ResultsError, f"{name} is {kind}, not a regular file"
                    ):
                        squeal.open(copy)
                    commands = {
                        ("summary.json", "a link"): ["squeal-merge", self.place / "out"],
                        ("eigenvalues.csv", "a named pipe"): ["squeal-plot"],
                    }
                    for command in (commands[key] for key in [(name, kind)] if key in commands):
                        failed = subprocess.run(
                            [repository / "scripts" / command[0], *command[1:], copy],
                            capture_output=True,
                            text=True,
                            timeout=60,
                        )
                        self.assertEqual(
                            (failed.returncode, len(failed.stderr.splitlines())),
                            (1, 1),
                            failed.stderr,
                        )
                        self.assertIn(f"{name} is {kind}, not a regular file", failed.stderr)
                    shutil.rmtree(copy)

    def test_damaged_fields_are_named(self):
        copy = self.place / "fields"
        shutil.copytree(self.place / "belt", copy)
        whole = (copy / "results.h5").read_bytes()
        for damaged in (
            whole[: len(whole) // 2],
            whole[:100],
            b"",
            whole.replace(b"eigenvalues", b"eigenvolues"),
        ):
            (copy / "results.h5").write_bytes(damaged)
            with self.assertRaisesRegex(squeal.ResultsError, "results.h5 is damaged: "):
                squeal.open(copy).fastest_mode(friction=1.2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
