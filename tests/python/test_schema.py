#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Tables of runs against their schema, and damaged ones, which are refused: test_schema.py PROGRAM
RESULTS, with the results of after_flutter.py.

With SQUEAL_LONG in the environment, ten times as many damaged tables.
"""
import csv
import io
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
folders = ("python", "tests/support/run", "tests/support/steady")
sys.path[:0] = [str(repository / folder) for folder in folders]
sys.dont_write_bytecode = True
import after_flutter
import squeal
from pressed_block import pressed_block
from squeal import schema
from squeal.agreement import require_agreement
from squeal.tables import read_table

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")
MADE = sys.argv.pop(1) if len(sys.argv) > 1 else None
LONG = bool(os.environ.get("SQUEAL_LONG"))
DAMAGES = 20000 if LONG else 2000
LAYERS = [
    "-mesh_set",
    "nx=4,ny_disc=2,ny_pad=2,order=2",
    "-modes_count",
    "30",
    "-report_fields",
    "off",
]
# Shipped cases on small meshes, and a block of which nodes open: all tables that there are.
RUNS = {
    "layers": [
        "-options_file",
        repository / "options/two_layers_moving.yaml",
        *LAYERS,
        "-flutter_friction",
        "0,0.2,0.4",
        "-flutter_track",
        "on",
        "-flutter_sensitivities",
    ],
    "chain": ["-options_file", repository / "options/external_chain.yaml"],
    "belt": ["-options_file", repository / "options/external.yaml"],
    "layer": [
        "-options_file",
        repository / "options/layer.yaml",
        "-report_fields",
        "off",
        "-modes_count",
        "20",
    ],
    "opening": pressed_block("nx=8,ny=8", modes=20, frictions="0:0.5:0.1"),
}


def cells_of(text):
    return list(csv.reader(io.StringIO(text)))


def text_of(rows):
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows(rows)
    return out.getvalue()


class Tables(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.place = Path(temporary.name)
        for name, words in RUNS.items():
            subprocess.run(
                [PROGRAM, *words, "-report_dir", cls.place / name, "-quiet"],
                check=True,
                stdout=subprocess.DEVNULL,
            )
        after_flutter.RUN.place(PROGRAM, MADE, cls.place / "brake")
        cls.runs = {name: squeal.open(cls.place / name) for name in ("brake", *RUNS)}

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

    # --- damage by hand: what is said ---

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

    # --- damage at random ---

    def damaged(self, text, table, generator):
        """A damaged text and whether it has to be refused; other damage may be the table of another
        run."""
        rows = cells_of(text)
        kind = generator.choice(
            ["column", "row", "double", "end", "cell", "cell", "cell", "cell", "name", "byte"]
        )
        line, at = generator.randrange(1, len(rows)), generator.randrange(len(rows[0]))
        if kind == "column":
            return text_of([row[:at] + row[at + 1 :] for row in rows]), True
        if kind == "row":
            return text_of(rows[:line] + rows[line + 1 :]), True
        if kind == "double":
            return text_of(rows[:line] + rows[line - (line > 1) :]), True
        if kind == "end":
            return text[: generator.randrange(len(text))], True
        if kind == "name":
            rows[0][at] = generator.choice(["", "x", rows[0][at - 1], rows[0][at].upper()])
            return text_of(rows), True
        if kind == "byte":
            place = generator.randrange(len(text))
            return text[:place] + generator.choice('\0"\n,x-.9é\r') + text[place + 1 :], False
        column = table.column(rows[0][at])
        value = generator.choice(
            [
                "nan",
                "inf",
                "1.2.3",
                "text",
                "",
                "0x10",
                "1e999",
                "é",
                " ",
                "1 2",
                "−1",
                *column.words,
            ]
        )
        rows[line][at] = value
        allowed = (value == "" and column.empty) or (value in ("nan", "inf") and column.open)
        free = column.kind == "word" and (not column.words or value in column.words)
        # The summary lists these words as well.
        known = column.name in ("verdict", "class") and value in column.words
        return text_of(rows), known or not (allowed or free)

    def test_thousands_of_damaged_tables(self):
        """Each is refused by a ResultsError; and damage that no reader can know of ends in no other
        exception."""
        seed = random.randrange(10**6)
        generator = random.Random(seed)
        tables = [
            (run, name)
            for run, results in self.runs.items()
            for name in results.texts
            if len(results.texts[name])
        ]
        refused = 0
        for number in range(DAMAGES):
            run, name = tables[number % len(tables)]
            results, path = self.runs[run], self.place / run / f"{name}.csv"
            whole = path.read_text()
            text, must = self.damaged(whole, schema.schema_of(name), generator)
            if text == whole:
                continue
            damaged = self.place / "damaged" / path.name
            damaged.parent.mkdir(exist_ok=True)
            damaged.write_text(text, newline="")
            try:  # as squeal.open() does it
                _, values = read_table(damaged, results.summary["tables"][name])
                # The others are as they were
                require_agreement(damaged.parent, results.summary, {name: values})
                self.assertFalse(
                    must,
                    (
                        f"seed {seed}, number {number}: {path} was accepted"
                        f" with\n{self.difference(whole, text)}"
                    ),
                )
            except squeal.ResultsError as error:
                refused += 1
                self.assertIn(path.name, str(error))
                self.assertNotIn("\n", str(error))
            except (ArithmeticError, LookupError, TypeError, ValueError, OSError) as error:
                self.fail(
                    f"seed {seed}, number {number}: {path}:"
                    f" {error!r}\n{self.difference(whole, text)}"
                )
        print(f"{refused} of {DAMAGES} damaged tables were refused", file=sys.stderr)
        self.assertGreater(refused, 0.7 * DAMAGES)

    @staticmethod
    def difference(whole, text):
        return "\n".join(
            f"{one!r} became {other!r}"
            for one, other in zip(whole.splitlines(), text.splitlines())
            if one != other
        )[:2000]

    def test_the_commands_refuse_in_one_line(self):
        generator = random.Random(1)
        for run, name, commands in (
            ("brake", "regime_cycles", (["squeal-plot", "regime"], ["squeal-report"])),
            ("chain", "eigenvalues", (["squeal-plot"], ["squeal-merge", self.place / "out"])),
        ):
            copy = self.place / f"commands_{run}"
            shutil.copytree(self.place / run, copy)
            whole = (copy / f"{name}.csv").read_text()
            must = False
            while not must:
                text, must = self.damaged(whole, schema.schema_of(name), generator)
            (copy / f"{name}.csv").write_text(text)
            before = sorted(copy.iterdir())
            for command in commands:
                failed = subprocess.run(
                    [repository / "scripts" / command[0], *command[1:], copy],
                    capture_output=True,
                    text=True,
                )
                self.assertEqual(
                    (failed.returncode, len(failed.stderr.splitlines())), (1, 1), failed.stderr
                )
                self.assertIn(f"{name}.csv", failed.stderr)
            self.assertEqual(sorted(copy.iterdir()), before)
            self.assertFalse((self.place / "out").exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
