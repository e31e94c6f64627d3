#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The job scripts of scripts/batch under Slurm on this machine: test_slurm.py PROGRAM FOLDER. As
root; scripts/dev/test_cluster calls it."""
import json
import os
import re
import sys
import time
import unittest
from pathlib import Path

import numpy as np

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(Path(__file__).parent)]
sys.dont_write_bytecode = True
import squeal
from slurm_here import Slurm

# Not resolve(): a link keeps it short
PROGRAM, FOLDER = (
    Path(sys.argv.pop(1)).resolve(),
    Path(sys.argv.pop(1)).absolute(),
)
BATCH = repository / "scripts/batch"
SMALL = ["--mem-per-cpu=1G", "--hint=nomultithread"]


class Jobs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # Settings of a crowded machine, as the tests have them, would hide what a job script lacks.
        for name in [
            name
            for name in os.environ
            if name.startswith(("OMPI_MCA_", "OMP_", "OPENBLAS_", "SLURM_"))
        ]:
            del os.environ[name]
        os.environ.update(
            OMPI_ALLOW_RUN_AS_ROOT="1",
            OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
            SQUEAL_HOME=str(repository),
            SQUEAL=str(PROGRAM),
        )
        (FOLDER / "slurm").mkdir()
        cls.slurm = cls.enterClassContext(Slurm(FOLDER / "slurm"))

    def setUp(self):
        self.folder = FOLDER / self.id().rpartition(".")[2]
        self.folder.mkdir()

    def submit(self, *words, **environment):
        """Submits a job from the folder of the test and returns its number."""
        before = {name: os.environ.get(name) for name in environment}
        self.slurm.environment.update(environment)
        try:
            return self.slurm.call("sbatch", "--parsable", *SMALL, *words, cwd=self.folder)
        finally:
            for name, value in before.items():
                if value is None:
                    del self.slurm.environment[name]
                else:
                    self.slurm.environment[name] = value

    def end(self, job, seconds=300):
        """Waits for the end of a job and returns its state and the exit code of its script."""
        self.slurm.wait(lambda: self.ended(job), seconds, f"job {job}: {self.log()}")
        return self.ended(job)

    def ended(self, job):
        text = self.slurm.call("scontrol", "--oneliner", "show", "job", job)
        states = re.findall(r" JobState=(\w+)", text)
        if not set(states) <= {
            "COMPLETED",
            "FAILED",
            "CANCELLED",
            "TIMEOUT",
            "NODE_FAIL",
            "OUT_OF_MEMORY",
        }:
            return None  # also SIGNALING, and others on the way
        return set(states), {int(code) for code in re.findall(r" ExitCode=(\d+):", text)}

    def log(self):
        return "".join(
            path.read_text(errors="replace") for path in sorted(self.folder.glob("*.log"))
        )

    def done(self, job, seconds=300):
        self.assertEqual(self.end(job, seconds), ({"COMPLETED"}, {0}), self.log())

    # --- one job ---

    def test_job(self):
        """By both launchers: two ranks, one thread each, each on a core of its own; nothing is left
        on the scratch disk."""
        scratch = self.folder / "scratch"
        scratch.mkdir()
        spy = self.script(
            "spy",
            f"""
            here=${{OMPI_COMM_WORLD_RANK:-${{SLURM_PROCID:-0}}}}
            {{
              env -u OMP_NUM_THREADS nproc
              echo $OMP_NUM_THREADS $OPENBLAS_NUM_THREADS
              ls -d "$MUMPS_OOC_TMPDIR"
              env | grep -c 'yield_when_idle=1\\|oversubscribe=1'
            }} >{self.folder}/rank_$here 2>&1 || true
            exec {PROGRAM} "$@" -report_dir {self.folder}/results_$LAUNCHED""",
        )
        cores = min(2, len(os.sched_getaffinity(0)))
        tables = []
        for launcher in ("srun", "mpirun"):
            job = self.submit(
                f"--ntasks={cores}",
                "--time=20",
                BATCH / "job.slurm",
                repository / "options/layer.yaml",
                "-mesh_set",
                "nx=12,ny=4",
                "-modes_count",
                "40",
                SQUEAL=str(spy),
                LAUNCHED=launcher,
                SQUEAL_LAUNCHER=launcher,
                SQUEAL_SCRATCH=str(scratch),
                OMPI_MCA_mpi_yield_when_idle="1",
            )
            self.done(job)
            for rank in range(cores):
                printed = (self.folder / f"rank_{rank}").read_text().split("\n")
                self.assertEqual(
                    printed[:4], ["1", "1 1", f"{scratch}/squeal_{job}", "0"], launcher
                )
                (self.folder / f"rank_{rank}").unlink()
            self.assertEqual(list(scratch.iterdir()), [])
            results = squeal.open(self.folder / f"results_{launcher}")
            self.assertEqual(results.summary["ranks"], cores)
            tables.append(results.eigenvalues["s"].to_numpy())
        np.testing.assert_allclose(tables[0], tables[1], rtol=1e-8)

    def test_job_that_cannot_run(self):
        job = self.submit("--ntasks=1", "--time=20", BATCH / "job.slurm", "nowhere.yaml")
        self.assertEqual(self.end(job), ({"FAILED"}, {1}))
        self.assertIn("batch: there is no file 'nowhere.yaml'", self.log())

    # --- an array and its merge ---

    def test_array_and_merge(self):
        """Four parts of a grid, then the merge: its eigenvalues are those of one run over the grid.
        Both runs correct their bases by other vectors, so that they agree to the sum of their
        estimated errors, here below 1e-8 each, and not to the last digit.
        """
        case = repository / "options/disc_brake_map.yaml"
        common = ["-modes_count", "50", "-flutter_friction", "0.2,0.5,0.8", "-flutter_damping", "0"]
        speeds, pressures = ("1", "3"), ("0.5", "2")
        (self.folder / "parts.txt").write_text(
            "# speeds and pressures\n\n"
            + "".join(
                f"-flutter_speed {speed} -flutter_pressure {pressure}  # a part\n"
                for speed in speeds
                for pressure in pressures
            )
        )
        # Two of the four parts are taken by each of the first two tasks of three, one after the
        # other.
        array = self.submit(
            "--array=1-3",
            "--ntasks=1",
            "--time=20",
            BATCH / "array.slurm",
            case,
            "parts.txt",
            "parts",
            *common,
        )
        merge = self.submit(
            f"--dependency=afterany:{array}",
            "--ntasks=1",
            "--time=20",
            f"--wrap={repository}/scripts/squeal-merge parts/merged parts/part_*",
            "--output=merge.log",
        )
        whole = self.submit(
            "--ntasks=1",
            "--time=20",
            BATCH / "job.slurm",
            case,
            *common,
            "-flutter_speed",
            "1,3",
            "-flutter_pressure",
            "0.5,2",
            "-report_dir",
            "whole",
        )
        self.done(array)
        self.done(merge)
        self.done(whole)
        self.assertEqual(
            sorted(path.name for path in (self.folder / "parts").iterdir()),
            ["merged", *(f"part_00{n}" for n in range(1, 5))],
        )
        one, other = (squeal.open(self.folder / name) for name in ("parts/merged", "whole"))
        names = [*squeal.PARAMETERS, "mode", "verdict"]
        self.assertEqual(len(one.points), 12)
        self.assertEqual(
            one.eigenvalues[names].to_numpy().tolist(), other.eigenvalues[names].to_numpy().tolist()
        )
        apart = np.abs(one.eigenvalues["s"] - other.eigenvalues["s"]) / np.abs(
            other.eigenvalues["s"]
        )
        bound = one.eigenvalues["error_estimate"] + other.eigenvalues["error_estimate"]
        print(
            f"merged and whole: {len(apart)} eigenvalues, up to {apart.max():.1e} apart, bound up"
            f" to {bound.max():.1e}"
        )
        self.assertTrue((apart <= bound + 1e-13).all())
        self.assertLess(bound.max(), 2e-8)

    # --- jobs that are cut off ---

    STAND_IN = """
        # Replaces the program: it needs {work} s of work in all and stops for SIGUSR1 and SIGTERM,
        # with a checkpoint that takes 5 s.
        words="$*"
        while [ $# -gt 0 ]; do
          case $1 in -report_dir) dir=$2 ;; -resume) resume=yes ;; esac
          shift
        done
        if [ "${{OMPI_COMM_WORLD_RANK:-${{SLURM_PROCID:-0}}}}" != 0 ]; then first=no; fi
        mkdir -p "$dir/interrupted"
        count=0
        checkpoint=$dir/interrupted/checkpoint
        if [ -n "${{resume:-}}" ] && [ -f "$checkpoint" ]; then count=$(cat "$checkpoint"); fi
        [ -n "${{first:-}}" ] || echo "started at $count: $words" >>"$dir/starts"
        stop() {{
          trap '' USR1 TERM
          sleep 5
          if [ -z "${{first:-}}" ]; then
            echo "$count" >"$checkpoint"
            echo "stopped by $1" >>"$dir/starts"
          fi
          exit 3
        }}
        trap 'stop USR1' USR1
        trap 'stop TERM' TERM
        while [ "$count" -lt {work} ]; do sleep 1; count=$((count + 1)); done
        if [ -z "${{first:-}}" ]; then
          echo '{{"complete": true}}' >"$dir/summary.json"
          rm -r "$dir/interrupted"
        fi
    """

    def script(self, name, text):
        path = self.folder / name
        path.write_text("#!/bin/bash\n" + text)
        path.chmod(0o755)
        return path

    def test_cut_off_and_resubmitted(self):
        """A job of one minute, the shortest that Slurm knows, with work for more: by both
        launchers, until it is done. Slurm looks at time limits now and then, so that the warning
        may come up to a minute early; the scripts rely on nothing else.
        """
        stand_in = self.script("stand_in", self.STAND_IN.format(work=65))
        scratch = self.folder / "scratch"
        scratch.mkdir()
        jobs = {
            launcher: self.submit(
                "--ntasks=1",
                "--time=1",
                "--signal=B:USR1@20",
                f"--output={launcher}.log",
                BATCH / "resubmit.slurm",
                repository / "options/layer.yaml",
                "-report_dir",
                launcher,
                SQUEAL=str(stand_in),
                SQUEAL_LAUNCHER=launcher,
                SQUEAL_SCRATCH=str(scratch),
            )
            for launcher in ("srun", "mpirun")
        }
        for launcher, job in jobs.items():
            self.done(job, 600)
            starts = (self.folder / launcher / "starts").read_text().splitlines()
            self.assertGreaterEqual(len(starts), 3, starts)
            self.assertNotIn("-resume", starts[0])
            self.assertRegex(starts[0], "^started at 0: ")
            for stopped, started in zip(starts[1::2], starts[2::2]):
                self.assertEqual(stopped, "stopped by USR1")
                self.assertRegex(started, "^started at [1-9].* -resume$")
            self.assertTrue((self.folder / launcher / "summary.json").exists())
        self.assertEqual(list(scratch.iterdir()), [])

    def test_array_goes_on_where_it_was_cut_off(self):
        """A task with two parts is warned in its second one: it goes on there, and does not do the
        first one again."""
        stand_in = self.script("stand_in", self.STAND_IN.format(work=5))
        (self.folder / "parts.txt").write_text("-flutter_speed 1\n-flutter_speed 2\n")
        job = self.submit(
            "--array=1",
            "--ntasks=1",
            "--time=20",
            BATCH / "array.slurm",
            repository / "options/layer.yaml",
            "parts.txt",
            "out",
            SQUEAL=str(stand_in),
        )
        first, second = (self.folder / "out" / f"part_00{number}" for number in (1, 2))
        self.slurm.wait((second / "starts").exists, 60, f"the second part: {self.log()}")
        time.sleep(2)
        self.slurm.call("scancel", "--batch", "--signal=USR1", job)
        self.done(job)
        self.assertEqual(len((first / "starts").read_text().splitlines()), 1)
        starts = (second / "starts").read_text().splitlines()
        self.assertEqual(len(starts), 3, starts)
        self.assertRegex(starts[2], "^started at [1-9].* -flutter_speed 2 .*-resume$")
        self.assertEqual(list((self.folder / "out").glob(".done*")), [])

    def test_restarts_are_bounded(self):
        stand_in = self.script("stand_in", self.STAND_IN.format(work=100))
        job = self.submit(
            "--ntasks=1",
            "--time=20",
            BATCH / "resubmit.slurm",
            repository / "options/layer.yaml",
            "-report_dir",
            "out",
            SQUEAL=str(stand_in),
            SQUEAL_RESTARTS="0",
        )
        self.slurm.wait((self.folder / "out/starts").exists, 60, self.log())
        time.sleep(1)
        self.slurm.call("scancel", "--batch", "--signal=USR1", job)
        self.assertEqual(self.end(job), ({"FAILED"}, {3}), self.log())
        self.assertIn("has been put back 0 times (SQUEAL_RESTARTS) and is not done", self.log())

    def test_cancelled_job_stays_cancelled(self):
        """scancel sends SIGTERM to all processes of the job: the run keeps a checkpoint, by either
        launcher, and is not put back."""
        stand_in = self.script("stand_in", self.STAND_IN.format(work=100))
        for launcher in ("srun", "mpirun"):
            job = self.submit(
                "--ntasks=2" if len(os.sched_getaffinity(0)) > 1 else "--ntasks=1",
                "--time=20",
                BATCH / "resubmit.slurm",
                repository / "options/layer.yaml",
                "-report_dir",
                launcher,
                SQUEAL=str(stand_in),
                SQUEAL_LAUNCHER=launcher,
            )
            self.slurm.wait((self.folder / launcher / "starts").exists, 60, self.log())
            time.sleep(2)
            self.slurm.call("scancel", job)
            state, _ = self.end(job)
            self.assertEqual(state, {"CANCELLED"})
            self.assertTrue((self.folder / launcher / "interrupted/checkpoint").exists(), launcher)
            self.assertEqual(
                (self.folder / launcher / "starts").read_text().splitlines()[1:],
                ["stopped by TERM"],
            )

    def test_program_cut_off_and_resubmitted(self):
        """The program itself: what it ends with after an interruption is what it finds without
        one."""
        words = [
            repository / "options/disc_brake.yaml",
            "-flutter_friction",
            "0:0.6:0.05",
            "-checkpoint_interval",
            "0",
        ]
        plain = self.submit(
            "--ntasks=1", "--time=20", BATCH / "job.slurm", *words, "-report_dir", "plain"
        )
        self.done(plain)
        job = self.submit(
            "--ntasks=1", "--time=20", BATCH / "resubmit.slurm", *words, "-report_dir", "resumed"
        )
        self.slurm.wait(
            lambda: (
                re.search(
                    "flutter .* points, basis", (self.folder / f"squeal_{job}.log").read_text()
                )
                if (self.folder / f"squeal_{job}.log").exists()
                else False
            ),
            120,
            "the first eigenvalues",
        )
        self.slurm.call("scancel", "--batch", "--signal=USR1", job)
        self.slurm.wait(lambda: "is put back into the queue" in self.log(), 60, self.log())
        stopped = json.loads((self.folder / "resumed/interrupted/summary.json").read_text())
        self.assertIs(stopped["complete"], False)
        self.done(job)
        self.assertIs(squeal.open(self.folder / "resumed").summary["resumed"], True)
        one, other = (squeal.open(self.folder / name).eigenvalues for name in ("resumed", "plain"))
        names = [*squeal.PARAMETERS, "mode", "verdict"]
        self.assertEqual(one[names].to_numpy().tolist(), other[names].to_numpy().tolist())
        self.assertTrue(
            (
                np.abs(one["s"] - other["s"])
                <= np.abs(other["s"]) * (1e-13 + one["error_estimate"] + other["error_estimate"])
            ).all()
        )


if __name__ == "__main__":
    unittest.main(verbosity=2)
