#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The PBS scripts of scripts/batch, run by hand with the variables that PBS would set: there is no
PBS in Debian to submit them to."""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]

# Tells its options, and ends with 3 as soon as SIGUSR1 comes, or with 0 after three seconds.
STAND_IN = """#!/bin/bash
echo "scratch $(ls -d "$MUMPS_OOC_TMPDIR"), threads $OMP_NUM_THREADS, options $*"
trap 'exit 3' USR1
for ((i = 0; i < 30; ++i)); do sleep 0.1; done
"""


class Scripts(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        for name in ("case.yaml", "nodes"):
            (self.folder / name).write_text("here\n")
        (self.folder / "parts.txt").write_text(
            "# speeds\n-flutter_speed 1\n\n-flutter_speed 2  # the second\n"
        )
        (self.folder / "program").write_text(STAND_IN)
        (self.folder / "program").chmod(0o755)

    def run_script(self, name, **variables):
        environment = {
            **{key: value for key, value in os.environ.items() if not key.startswith("SLURM_")},
            "PBS_JOBID": "12.here",
            "PBS_NODEFILE": str(self.folder / "nodes"),
            "PBS_O_WORKDIR": str(self.folder),
            "SQUEAL": str(self.folder / "program"),
            "SQUEAL_HOME": str(repository),
            "SQUEAL_SCRATCH": str(self.folder),
            "OMPI_ALLOW_RUN_AS_ROOT": "1",
            "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
            "OMPI_MCA_odls_base_sigkill_timeout": "1",
            "CASE": "case.yaml",
            **variables,
        }
        done = subprocess.run(
            [repository / "scripts/batch" / name],
            env=environment,
            text=True,
            capture_output=True,
            timeout=100,
            cwd="/",
        )
        self.assertFalse((self.folder / "squeal_12.here").exists())
        return done.returncode, done.stdout + done.stderr

    def test_job(self):
        code, text = self.run_script("job.pbs", OPTIONS="-report_dir out -quiet")
        self.assertEqual(code, 0, text)
        self.assertIn(
            (
                f"scratch {self.folder}/squeal_12.here, threads 1, options -options_file case.yaml"
                " -report_dir out -quiet\n"
            ),
            text,
        )

    def test_warning_before_the_walltime(self):
        code, text = self.run_script("job.pbs", WARN_AFTER="1")
        self.assertEqual(code, 3, text)
        self.assertIn("submit it again with -resume among OPTIONS", text)

    def test_array(self):
        task = dict(PARTS="parts.txt", FOLDER="out", OPTIONS="-quiet")
        code, text = self.run_script("array.pbs", PBS_ARRAY_INDEX="2", **task)
        self.assertEqual(code, 0, text)
        self.assertIn(
            "options -options_file case.yaml -flutter_speed 2 -report_dir out/part_002 -quiet\n",
            text,
        )
        code, text = self.run_script("array.pbs", PBS_ARRAY_INDEX="3", **task)
        self.assertEqual(
            sorted(path.name for path in (self.folder / "out").iterdir()), ["part_001", "part_002"]
        )
        self.assertEqual(
            (code, text),
            (1, "batch: parts.txt has no line 3: submit with as many tasks as it has lines\n"),
        )

    def test_missing_case(self):
        code, text = self.run_script("job.pbs", CASE="nowhere.yaml")
        self.assertEqual((code, text), (1, "batch: there is no file 'nowhere.yaml'\n"))


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    unittest.main(verbosity=2)
