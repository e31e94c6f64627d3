#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Runs that are cut off and resumed, and the event log: test_resume.py PROGRAM MPIEXEC.

With SQUEAL_LONG in the environment, five random moments of several kinds of runs instead of one
moment of one.
"""
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [
    str(repository / folder)
    for folder in ("python", "tests/support/harness", "tests/support/steady")
]
sys.dont_write_bytecode = True
import squeal
from pressed_block import pressed_block
from watched_run import WatchedRun

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")
MPIEXEC = sys.argv.pop(1) if len(sys.argv) > 1 else "mpirun -n"
LONG = bool(os.environ.get("SQUEAL_LONG"))
# A run that is continued takes the steps of the one that was not cut off, except for round-off:
# eigenvalues differ by that times their condition numbers, some thousand at most here.
SAME = 1e-10

SIZE = "n_pad_theta=6,n_free_theta=8,n_mount=1,n_plate=1,n_inside=1,n_pad_r=3,n_hat=1,n_h_ring=1"
BRAKE = [
    "-options_file",
    repository / "options/disc_brake.yaml",
    "-modes_count",
    "40",
    "-flutter_band",
    "9000",
    "-report_fields",
    "off",
    "-mesh_set",
    SIZE,
    "-flutter_friction",
    "0:0.6:0.03",
]
BLOCK = pressed_block("nx=12,ny=24", modes=60, frictions="0:0.5:0.02")
BELT = ["-options_file", repository / "options/external.yaml", "-report_fields", "off"]


def start(folder, options, ranks=2):
    return WatchedRun(folder, [*MPIEXEC.split(), str(ranks), PROGRAM], options)


def done(folder, options, ranks=2):
    return start(folder, options, ranks).finish_well()


def files_of(folder):
    """All files except the lock and the options that a killed run leaves: the next run removes
    them, even if it is refused."""
    left = {".squeal.lock", ".partial/options.txt"}
    files = {
        str(path.relative_to(folder)): path.read_bytes()
        for path in Path(folder).rglob("*")
        if path.is_file()
    }
    return {name: content for name, content in files.items() if name not in left}


class Resumed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.place = Path(temporary.name)
        cls.whole = done(cls.place / "whole", BRAKE)
        # A run that is killed once an entry of its checkpoint is written, over results of an
        # earlier run.
        cls.cut_off = cls.place / "cut_off"
        shutil.copytree(cls.whole.folder, cls.cut_off)
        run = start(cls.cut_off, [*BRAKE, "-checkpoint_interval", "0"])
        run.wait_for(
            lambda event: event["event"] == "checkpoint" and "_points_0003" in event["file"]
        )
        run.kill_ranks()
        assert run.finish() != 0, run.text()

    def setUp(self):
        self.folder = self.place / self.id().split(".")[-1]

    def expect_same(self, folder, whole):
        """The results of two runs agree, and the first has solved for as many right-hand sides in
        all."""
        ours, theirs = squeal.open(folder), squeal.open(whole)
        self.assertEqual(len(ours.eigenvalues), len(theirs.eigenvalues))
        error = np.abs(ours.eigenvalues["s"] - theirs.eigenvalues["s"]) / np.abs(
            theirs.eigenvalues["s"]
        )
        self.assertLess(error.max(), SAME)
        self.assertEqual(list(ours.eigenvalues["verdict"]), list(theirs.eigenvalues["verdict"]))
        if theirs.critical is not None:
            self.assertEqual(len(ours.critical), len(theirs.critical))
            self.assertLess(
                np.abs(ours.critical["friction"] - theirs.critical["friction"])
                .to_numpy()
                .max(initial=0),
                SAME,
            )
        if theirs.reactions is not None:  # computed from the displacements of the checkpoint
            columns = [name for name in theirs.reactions if name.startswith(("force", "moment"))]
            here, there = (one.reactions[columns].to_numpy() for one in (ours, theirs))
            self.assertEqual(here.shape, there.shape)
            self.assertLess(np.abs(here - there).max(), SAME * np.abs(there).max())
        solves = [
            [
                part["solves"]
                for part in json.loads((Path(one) / "summary.json").read_text())["active_sets"]
            ]
            for one in (folder, whole)
        ]
        # Rounding may decide on directions that are all but dependent on others; a batch that is
        # solved again costs more.
        for here, there in zip(*solves, strict=True):
            self.assertLessEqual(abs(here - there), 0.02 * there)
        self.assertFalse((Path(folder) / "interrupted").exists())

    def expect_kept(self, before):
        after = files_of(self.folder)
        self.assertEqual([name for name, text in before.items() if after.get(name) != text], [])

    def test_a_killed_run_goes_on(self):
        shutil.copytree(self.cut_off, self.folder)
        self.expect_kept(files_of(self.whole.folder))
        again = done(self.folder, [*BRAKE, "-resume"])
        self.assertNotIn("modes", again.stages())
        self.expect_same(self.folder, self.whole.folder)

    def test_a_run_that_is_asked_to_stop(self):
        shutil.copytree(self.whole.folder, self.folder)
        before = files_of(self.folder)
        # A minute to the first entry: what is asked to stop writes it at once
        run = start(self.folder, BRAKE)
        run.wait_for(lambda event: event["event"] == "points" and event["done"] >= 5)
        run.process.send_signal(signal.SIGUSR1)
        self.assertEqual(run.finish(), 3, run.text())
        self.assertEqual(run.events()[-1], run.events()[-1] | {"event": "end", "exit_code": 3})
        self.expect_kept(before)
        part = squeal.open(self.folder / "interrupted")
        whole = squeal.open(self.whole.folder)
        self.assertIs(part.summary["complete"], False)
        points = sorted(set(part.eigenvalues["friction"]))
        self.assertGreaterEqual(len(points), 5)
        # Those points are done: their eigenvalues are those of the whole run.
        there = whole.eigenvalues[whole.eigenvalues["friction"].isin(points)]
        self.assertLess(
            (
                np.abs(part.eigenvalues["s"].to_numpy() - there["s"].to_numpy())
                / np.abs(there["s"])
            ).max(),
            SAME,
        )
        again = done(self.folder, [*BRAKE, "-resume"])
        self.assertNotIn("modes", again.stages())
        self.assertIs(squeal.open(self.folder).summary["complete"], True)
        self.expect_same(self.folder, self.whole.folder)

    def test_a_stop_in_the_first_and_in_the_last_stage(self):
        # mpirun asks its whole process group, and so the process in which gmsh reads the geometry.
        for stage, kept in (("mesh", False), ("track", True)):
            folder = self.place / f"stop_in_{stage}"
            run = start(folder, BRAKE)
            run.wait_for(
                lambda event, stage=stage: event["event"] == "stage_begin"
                and event["stage"] == stage
            )
            run.process.send_signal(signal.SIGUSR1)
            self.assertEqual(run.finish(), 3, run.text())
            self.assertEqual((folder / "interrupted/checkpoint/identity.json").exists(), kept)

    def test_a_killed_run_leaves_all_its_options(self):
        folder = self.place / "options"
        run = start(folder, BRAKE)
        run.wait_for(lambda event: event["event"] == "stage_begin")
        run.kill_ranks()
        self.assertNotEqual(run.finish(), 0)
        left = (folder / ".partial" / "options.txt").read_text()
        self.assertEqual(left, (self.place / "whole" / "options.txt").read_text())

    def test_what_cannot_be_continued(self):
        shutil.copytree(self.cut_off, self.folder)
        before = files_of(self.folder)
        entry = self.folder / "interrupted/checkpoint/sets_1_modes_0000.entry"
        for ranks, words, message in (
            (
                2,
                ["-flutter_friction", "0:0.6:0.02"],
                "option -flutter_friction was '0:0.6:0.03' and is '0:0.6:0.02'",
            ),
            (1, [], "the number of ranks was '2' and is '1'"),
            (
                2,
                ["-mesh_scale", "1.0000001"],
                "option -mesh_scale was not given and is '1.0000001'",
            ),
        ):
            run = start(self.folder, [*BRAKE, "-resume", *words], ranks)
            self.assertEqual(run.finish(), 1)
            self.assertIn(
                (
                    f"squeal: error: option -resume: the checkpoint in {entry.parent} belongs to"
                    f" another run: {message}"
                ),
                run.text(),
            )
            self.expect_kept(before)
        damaged = bytearray(entry.read_bytes())
        damaged[-100] ^= 1
        entry.write_bytes(damaged)
        run = start(self.folder, [*BRAKE, "-resume"])
        self.assertEqual(run.finish(), 1)
        self.assertIn(f"squeal: error: the checkpoint is damaged: {entry}", run.text())

    def test_nothing_to_continue(self):
        run = done(self.folder, [*BELT, "-resume"], 1)
        self.assertIn("there is no checkpoint in", run.text())
        self.assertIs(squeal.open(self.folder).summary["resumed"], False)

    def test_events(self):
        events = self.whole.events()
        self.assertEqual(events[0], events[0] | {"event": "start", "ranks": 2})
        self.assertEqual(events[-1], events[-1] | {"event": "end", "exit_code": 0})
        times = [event["elapsed_s"] for event in events]
        self.assertEqual(times, sorted(times))
        counted = [event["done"] for event in events if event["event"] == "points"]
        self.assertEqual(
            (counted, {event["total"] for event in events if event["event"] == "points"}),
            ([5, 21], {21}),
        )
        open_stages = []
        for event in events:  # every stage that begins ends, in order
            if event["event"] == "stage_begin":
                open_stages.append(event["stage"])
            elif event["event"] == "stage_end":
                self.assertEqual(open_stages.pop(), event["stage"])
        self.assertEqual(open_stages, [])
        self.assertLessEqual(
            {"mesh", "elasticity", "contact", "steady", "modes", "flutter", "track", "report"},
            self.whole.stages(),
        )

    def test_line(self):
        shown = {
            how: done(self.place / f"line_{how}", [*BELT, *words], 1).text().split("\r\033[K")
            for how, words in (
                ("line", ["-progress", "line"]),
                ("auto", []),
                ("quiet", ["-progress", "line", "-quiet"]),
            )
        }
        self.assertRegex("|".join(shown["line"]), r"point \d+ of \d+ · \d\d:\d\d")
        # It is gone at the end
        self.assertNotRegex("".join(shown["line"][1:]).split("\n")[-1], "point")
        self.assertEqual((len(shown["auto"]), len(shown["quiet"])), (1, 1))

    def test_a_log_that_cannot_be_written(self):
        run = subprocess.run(
            [
                PROGRAM,
                *map(str, BRAKE),
                "-report_dir",
                self.folder,
                "-log_json",
                self.place / "no/such.jsonl",
            ],
            capture_output=True,
            text=True,
        )
        self.assertEqual(run.returncode, 1)
        self.assertIn("squeal: error: option -log_json: cannot write", run.stderr)
        self.assertFalse(self.folder.exists())
        mine = self.place / "mine.txt"
        mine.write_text("mine")
        run = subprocess.run(
            [PROGRAM, *map(str, BRAKE), "-report_dir", self.folder, "-log_json", mine],
            capture_output=True,
            text=True,
        )
        self.assertEqual((run.returncode, mine.read_text()), (1, "mine"))
        self.assertIn("already exists and is not an event log", run.stderr)

    @unittest.skipUnless(LONG, "five random moments of each kind of run: SQUEAL_LONG")
    def test_random_moments(self):
        seed = random.randrange(10**6)
        random.seed(seed)
        kinds = {
            "plain": (2, BRAKE),
            "damped": (
                3,
                [
                    *BRAKE,
                    "-flutter_modal_damping",
                    "0.01",
                    "-flutter_friction",
                    "0:0.6:0.1",
                    "-flutter_damping",
                    "1,2",
                    "-flutter_sensitivities",
                ],
            ),
            "opening": (2, BLOCK),
            "sets by themselves": (2, [*BLOCK, "-flutter_released", "0"]),
            "several bases": (2, [*BLOCK, "-flutter_released", "1"]),
            "in all unknowns": (2, [*BLOCK, "-steady_full", "on", "-report_fields", "on"]),
            "speeds": (2, ["-options_file", repository / "options/two_layers_moving.yaml"]),
            "direct": (
                1,
                ["-options_file", repository / "options/layer.yaml", "-flutter_method", "direct"],
            ),
            "matrices": (2, ["-options_file", repository / "options/external_chain.yaml"]),
        }
        for name, (ranks, options) in kinds.items():
            begin = time.monotonic()
            whole = done(self.place / f"whole_{name}", options, ranks)
            takes = time.monotonic() - begin
            for number in range(5):
                with self.subTest(kind=name, number=number, seed=seed):
                    folder = self.place / f"random_{name}_{number}"
                    run = start(folder, [*options, "-checkpoint_interval", "0"], ranks)
                    time.sleep(random.uniform(0.1, 0.9) * takes)
                    run.kill_ranks()
                    run.finish()
                    done(folder, [*options, "-resume"], ranks)
                    self.expect_same(folder, whole.folder)


if __name__ == "__main__":
    unittest.main(verbosity=2)
