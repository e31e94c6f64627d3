# SPDX-License-Identifier: BSD-2-Clause
"""Files that commands add to the folder of a run, and the folder that a benchmark reads."""
import fcntl
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS.parent / "python"))

from squeal import ResultsError
from squeal.folder import LOCK, MANIFEST, Folder


class Figure:
    """Writes what a plot would."""

    def __init__(self, text):
        self.text = text

    def savefig(self, path, format):
        assert format == "png"
        Path(path).write_text(self.text)


class Full(Figure):
    def savefig(self, path, format):
        super().savefig(path, format)
        raise OSError(28, "No space left on device")


class ResultsOfARun(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "summary.json").write_text("{}")
        (self.folder / MANIFEST).write_text(
            "# squeal 0.1.0: the 2 files of a run\nmanifest.txt\nsummary.json\nvtk/\n"
        )

    def names(self):
        return sorted(os.listdir(self.folder))

    def refused(self, action):
        with self.assertRaises(ResultsError) as end:
            action()
        return str(end.exception)

    def test_enters_the_manifest_once(self):
        for text in ("first", "second"):
            Folder(self.folder).save("stability.png", Figure(text))
            self.assertEqual((self.folder / "stability.png").read_text(), text)
        lines = (self.folder / MANIFEST).read_text().splitlines()
        # the program checks the number of files; a folder kept for the user is none
        self.assertEqual(
            lines,
            [
                "# squeal 0.1.0: the 3 files of a run",
                "manifest.txt",
                "stability.png",
                "summary.json",
                "vtk/",
            ],
        )
        self.assertEqual(self.names(), [MANIFEST, "stability.png", "summary.json"])

    def test_overwrites_nothing_of_the_user(self):
        (self.folder / "stability.png").write_text("mine")
        self.assertIn(
            "is in the way",
            self.refused(lambda: Folder(self.folder).save("stability.png", Figure("plot"))),
        )
        self.assertEqual((self.folder / "stability.png").read_text(), "mine")
        self.assertNotIn("stability.png", (self.folder / MANIFEST).read_text())
        self.assertEqual(self.names(), [MANIFEST, "stability.png", "summary.json"])

    def test_keeps_out_of_a_run(self):
        results = Folder(self.folder)
        with (self.folder / LOCK).open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_SH)  # as the ranks of a run hold it
            self.assertIn(
                "a run is writing",
                self.refused(lambda: results.save("stability.png", Figure("plot"))),
            )
        # Another run's results
        (self.folder / MANIFEST).write_text("# squeal 0.1.0: the 1 files of a run\nmanifest.txt\n")
        self.assertIn(
            "replaced meanwhile",
            self.refused(lambda: results.save("stability.png", Figure("plot"))),
        )
        self.assertFalse((self.folder / "stability.png").exists())

    def test_disc_full(self):
        Folder(self.folder).save("stability.png", Figure("before"))
        message = self.refused(
            lambda: Folder(self.folder).save("stability.png", Full("half of it"))
        )
        self.assertIn("stability.png: No space left on device", message)
        self.assertEqual((self.folder / "stability.png").read_text(), "before")
        self.assertEqual(self.names(), [MANIFEST, "stability.png", "summary.json"])


SUMMARY = {
    "dofs": 1,
    "ranks": 1,
    "frictions": [],
    "active_sets": [],
    "stages": {
        name: {"wall_s": 1.0, "peak_memory_bytes": 1}
        for name in ("factor", "steady", "modes", "flutter", "elasticity")
    },
    "sparse_work": {"factorisations": 2, "right_hand_sides": 30, "projections": 4},
}
RUN = """#!/usr/bin/python3
import json, os, sys
words = sys.argv[1:]
folder = [after for word, after in zip(words, words[1:]) if word == "-report_dir"][-1]
os.makedirs(folder, exist_ok=True)
json.dump({**%r, "case": "this run"}, open(folder + "/summary.json", "w"))
"""


class Benchmark(unittest.TestCase):
    def test_reads_the_folder_of_report_dir(self):
        """The folder of an earlier benchmark was read instead."""
        with tempfile.TemporaryDirectory() as place:
            place = Path(place)
            scripts = place / "scripts"
            for name in ("bench/stages", "bench/stages.py", "lib/report_dir"):
                (scripts / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(SCRIPTS / name, scripts / name)
            (scripts / "run").write_text(RUN % SUMMARY)  # in the place of a run of minutes
            (scripts / "run").chmod(0o755)
            (scripts / "bench" / "floor").write_text("#!/bin/sh\necho 1.0\n")
            (scripts / "bench" / "floor").chmod(0o755)
            earlier = place / "results" / "benchmark_disc_brake"
            earlier.mkdir(parents=True)
            (earlier / "summary.json").write_text(json.dumps({**SUMMARY, "case": "an earlier run"}))
            elsewhere = [
                "-report_dir",
                "first",
                "-flutter_friction",
                "0.2",
                "-report_dir",
                str(place / "two words"),
            ]
            for options in (elsewhere, []):
                run = subprocess.run(
                    [scripts / "bench/stages", *options],
                    capture_output=True,
                    text=True,
                    check=True,
                    cwd=place,
                )
                self.assertIn("this run", run.stdout)
                self.assertIn("2 factorisations, 30 right hand sides, 4 proj", run.stdout)
                self.assertNotIn("an earlier run", run.stdout)
            self.assertFalse((place / "first").exists())


if __name__ == "__main__":
    unittest.main()
