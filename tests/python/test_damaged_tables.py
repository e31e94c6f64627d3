#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Tables damaged at random, which are refused: test_damaged_tables.py PROGRAM TABLES RESULTS, with
the results of all_tables.py and of after_flutter.py.

With SQUEAL_LONG in the environment, ten times as many damaged tables.
"""
import os
import random
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
from squeal.agreement import require_agreement
from squeal.tables import read_table

LONG = bool(os.environ.get("SQUEAL_LONG"))
DAMAGES = 20000 if LONG else 2000


class DamagedTables(OnTables):
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
            if text in (whole, text_of(cells_of(whole))):  # not damaged; quotes may be missing
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
