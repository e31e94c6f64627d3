#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Folders that a run does not take, and what it does not open there: test_folders.py PROGRAM
MPIEXEC."""
import concurrent.futures
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")
MPIEXEC = sys.argv.pop(1) if len(sys.argv) > 1 else "mpirun -n"
BELT = ["-options_file", repository / "options/external.yaml"]
PLANTS = {
    "a link": lambda path, foreign: path.symlink_to(foreign),
    "a named pipe": lambda path, _: os.mkfifo(path),
    "a folder": lambda path, _: path.mkdir(),
}
SECONDS = 60


def tree(folder):
    return sorted(
        (
            str(path.relative_to(folder)),
            path.read_bytes() if path.is_file() and not path.is_symlink() else None,
        )
        for path in folder.rglob("*")
    )


class Folders(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.place = Path(temporary.name)

    def run_program(self, ranks, *words, cwd=None, **environment):
        words = [
            *([*MPIEXEC.split(), str(ranks)] if ranks > 1 else []),
            PROGRAM,
            *map(
                str,
                [
                    *([] if "-options_file" in words else BELT),
                    *words,
                    "-report_fields",
                    "off",
                    "-quiet",
                ],
            ),
        ]
        return subprocess.run(
            words,
            capture_output=True,
            text=True,
            timeout=SECONDS,
            cwd=cwd,
            env={**os.environ, **environment},
        )

    def refused(self, rule, *words, ranks=(1, 2), **how):
        """By the rule, in one line of ours, on any number of ranks; nothing is written or
        blocks."""
        before = tree(self.place)
        for count in ranks:
            run = self.run_program(count, *words, **how)
            said = [line for line in run.stderr.splitlines() if line.startswith("squeal: error: ")]
            self.assertEqual((run.returncode, len(said)), (1, 1), run.stderr)
            self.assertIn(rule, said[0])
        self.assertEqual(tree(self.place), before)

    def test_folders_that_are_not_taken(self):
        (self.place / "notes").mkdir()
        (self.place / "notes/notes.txt").write_text("mine")
        (self.place / "link").symlink_to(self.place / "notes")
        (self.place / "root").symlink_to("/")
        os.mkfifo(self.place / "pipe")
        root, foreign = (
            "is the root of the file system",
            "is not empty and holds no earlier results",
        )
        home = tempfile.TemporaryDirectory()  # FLTK writes there as well
        self.addCleanup(home.cleanup)
        (Path(home.name) / "notes.txt").write_text("mine")
        trials = [
            (root, "/", {}),
            (root, "root/", {"cwd": self.place}),
            (foreign, self.place / "notes", {}),
            (foreign, f"{self.place}/notes/", {}),
            (foreign, self.place / "link", {}),
            (foreign, ".", {"cwd": self.place}),
            (foreign, home.name, {"HOME": home.name}),
            (foreign, repository, {}),
            ("notes.txt is a regular file, not a folder", self.place / "notes/notes.txt", {}),
            ("pipe is a named pipe, not a folder", self.place / "pipe", {}),
        ]
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            for done in [
                pool.submit(
                    self.refused, rule, "-report_dir", folder, ranks=(1 + number % 2,), **how
                )
                for number, (rule, folder, how) in enumerate(trials)
            ]:
                done.result()
        self.refused(
            foreign,
            "-report_dir",
            self.place / "new",
            "-report_matrices",
            self.place / "notes",
            ranks=[1],
        )
        self.assertFalse(any(Path("/").glob("*.csv")))

    def test_folders_that_are_taken(self):
        """New, empty, one with results, one that holds the log of events of this run, one that a
        case names."""
        (self.place / "logged").mkdir()
        for folder in ("results/case", "results/other", "named"):
            (self.place / folder).mkdir(parents=True)
            (self.place / folder / "notes.txt").write_text("mine")
        text = (
            (repository / "options/external.yaml")
            .read_text()
            .replace("file: external", f"file: {repository}/options/external")
        )
        (self.place / "case.yaml").write_text(text)
        (self.place / "other_case.yaml").write_text(text + "\nreport:\n  dir: named\n")
        (self.place / "of_root.yaml").write_text(text + "\nreport:\n  dir: /\n")
        for words in (
            ["-report_dir", "new/deep"],
            ["-report_dir", "new/deep/"],
            ["-report_dir", "logged", "-log_json", "logged/events.jsonl"],
            ["-report_dir", "logged"],
            ["-options_file", "case.yaml", "-report_dir", "results/case/"],
            ["-options_file", "other_case.yaml"],
        ):
            run = self.run_program(1, *words, cwd=self.place)
            self.assertEqual(run.returncode, 0, run.stderr)
        for folder in ("results/case", "named"):
            self.assertEqual((self.place / folder / "notes.txt").read_text(), "mine")
            self.assertTrue((self.place / folder / "summary.json").exists())
        self.refused(
            "is not empty and holds no earlier results",
            "-options_file",
            "case.yaml",
            "-report_dir",
            "results/other",
            ranks=[1],
            cwd=self.place,
        )
        self.refused(
            "/ is the root of the file system",
            "-options_file",
            "of_root.yaml",
            ranks=[2],
            cwd=self.place,
        )

    def test_checkpoints_are_regular_files(self):
        """A link at the next entry let -resume overwrite a foreign file, and a pipe blocked it."""
        whole = self.place / "whole"
        stopped = self.run_program(2, "-report_dir", whole, "-checkpoint_interval", "0")
        self.assertEqual(stopped.returncode, 0, stopped.stderr)
        foreign = self.place / "foreign.entry"
        foreign.write_text("mine")
        inside = "interrupted/checkpoint"
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            jobs = []
            for kind, plant in PLANTS.items():
                for name in (
                    f"{inside}/set_1_points_0000.entry.partial",
                    f"{inside}/set_1_modes_0000.entry",
                    f"{inside}/identity.json",
                    "interrupted",
                    inside,
                ):
                    if kind == "a folder" and name in ("interrupted", inside):
                        continue  # as it should be
                    folder = self.place / f"{kind} {name}".replace("/", " ")
                    shutil.copytree(whole, folder)
                    (folder / name).parent.mkdir(parents=True, exist_ok=True)
                    plant(folder / name, foreign)
                    rule = (
                        f"{folder / name} is {kind}, not a"
                        f" {'regular file' if '.' in Path(name).name else 'folder'}"
                    )
                    words = ["-report_dir", folder, *(["-resume"] if len(jobs) % 2 else [])]
                    jobs.append(pool.submit(self.run_program, 1 + len(jobs) % 2, *words))
                    jobs[-1].rule = rule
            for job in jobs:
                run = job.result()
                self.assertEqual(run.returncode, 1, run.stderr)
                self.assertIn(job.rule, run.stderr)
        self.assertEqual(foreign.read_text(), "mine")

    def test_files_of_results_are_regular_files(self):
        whole, foreign = self.place / "whole", self.place / "foreign"
        self.assertEqual(self.run_program(1, "-report_dir", whole).returncode, 0)
        foreign.write_text("mine")
        for kind, plant in PLANTS.items():
            for name, rule in (
                (".squeal.lock", f".squeal.lock is {kind}, not a regular file"),
                (".partial", ".partial is in the way"),
                ("manifest.txt", "is in the way"),
            ):
                if kind == "a folder" and name == ".partial":
                    continue
                with self.subTest(kind=kind, name=name):
                    folder = self.place / "copy"
                    shutil.copytree(whole, folder)
                    (folder / name).unlink(missing_ok=True)
                    plant(folder / name, foreign)
                    for ranks in (1, 2) if kind == "a link" else (1,):
                        run = self.run_program(ranks, "-report_dir", folder)
                        self.assertEqual(run.returncode, 1, run.stderr)
                        self.assertIn(rule, run.stderr)
                    self.assertEqual(foreign.read_text(), "mine")
                    shutil.rmtree(folder)

    def test_the_log_of_events_is_a_regular_file(self):
        foreign = self.place / "foreign"
        foreign.write_text("")  # an empty file was appended to through the link
        for kind, plant in PLANTS.items():
            log = self.place / f"{kind}.jsonl"
            plant(log, foreign)
            self.refused(
                f"option -log_json: {log} is {kind}, not a regular file",
                "-report_dir",
                self.place / "new",
                "-log_json",
                log,
                ranks=(2,),
            )
        run = self.run_program(1, "-report_dir", self.place / "new", "-log_json", "/dev/null")
        self.assertEqual(run.returncode, 0, run.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
