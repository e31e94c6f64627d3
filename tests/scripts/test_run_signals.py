# SPDX-License-Identifier: BSD-2-Clause
"""Signals sent to squeal-run, not to the program: the run stops in order or at once, and
returns another exit code for each. Call: test_run_signals.py PROGRAM."""
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
COARSE = [
    "-mesh_set",
    "n_pad_theta=8,n_free_theta=12,n_mount=2,n_plate=1,n_inside=1,n_pad_r=4,n_hat=2,n_h_ring=2",
    "-modes_count",
    "60",
    "-flutter_band",
    "7000",
]


# Seconds of work after the free modes. On a busy machine the run takes longer than the interval of
# checkpoints.
MANY_POINTS = [
    *COARSE,
    "-report_fields",
    "off",
    "-flutter_friction",
    "0:0.6:0.0025",
    "-checkpoint_interval",
    "100000",
]


class Signals(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def started(self, *words):
        environment = dict(os.environ, NP="2")
        return subprocess.Popen(
            [
                ROOT / "scripts" / "squeal-run",
                "disc_brake",
                "-report_dir",
                self.folder / "results",
                *words,
            ],
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )

    def stopped(self, sent):
        """Its exit code and error output after a signal at the free modes."""
        run = self.started(*MANY_POINTS)
        for line in run.stdout:
            if line.startswith("modes"):
                break
        run.send_signal(sent)
        _, error = run.communicate(timeout=120)
        return run.returncode, error

    def test_sigterm_stops_it_in_order(self):
        code, error = self.stopped(signal.SIGTERM)
        self.assertEqual(code, 3, error)
        self.assertTrue((self.folder / "results" / "interrupted" / "checkpoint").is_dir())
        self.assertFalse((self.folder / "results" / "summary.json").exists())

    def test_sigint_ends_it_at_once(self):
        code, error = self.stopped(signal.SIGINT)
        self.assertEqual(code, 130, error)
        self.assertNotIn("Traceback", error)
        self.assertFalse((self.folder / "results" / "interrupted").exists())

    def test_without_fields_and_signals(self):
        """There is no report, and it says why; the recipe does not resume or log."""
        log = self.folder / "log.json"
        run = self.started(
            "-report_fields",
            "off",
            "-flutter_friction",
            "0.4",
            "-log_json",
            log,
            "-progress",
            "plain",
            *COARSE,
        )
        out, error = run.communicate(timeout=120)
        self.assertEqual(run.returncode, 0, error)
        self.assertIn("there is no report, since no fields were written", out)
        self.assertNotIn("could not be made", error)
        self.assertTrue(
            json.loads((self.folder / "results" / "summary.json").read_text())["complete"]
        )
        recipe = (self.folder / "results" / "options.txt").read_text()
        self.assertIn("-flutter_friction", recipe)
        for name in ("-log_json", "-progress", "-resume"):
            self.assertNotIn(f"{name} ", recipe)

    def test_mistakes_have_exit_code_1(self):
        run = subprocess.run(
            [ROOT / "scripts" / "squeal-run", "nonsense"], capture_output=True, text=True
        )
        self.assertEqual(run.returncode, 1)
        self.assertIn("there is no case 'nonsense'", run.stderr)


class Lists(unittest.TestCase):
    def test_merge_and_checkpoint_agree_on_what_changes_no_number(self):
        import re

        source = (ROOT / "src/base/checkpoint/identity.cpp").read_text()
        exact = re.search(r"exact\{(.*?)\};", source, re.S).group(1)
        sys.path.insert(0, str(ROOT / "python"))
        from squeal import parts

        names = set(re.findall(r'"(\w+)"', exact))
        self.assertGreater(len(names), 4)
        for name in names:
            self.assertTrue(parts.indifferent(name), name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
