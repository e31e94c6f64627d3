#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The coarse disc brake after flutter, with periodic motions: after_flutter.py PROGRAM FOLDER runs
it. Two tests read it, from copies of FOLDER; without one they make the run themselves."""
import shutil
import subprocess
import sys
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[3]
OPTIONS = {
    "options_file": REPOSITORY / "options/disc_brake_regime.yaml",
    "modes_count": "60",
    "flutter_band": "9000",
    "mesh_set": "n_pad_theta=8,n_free_theta=12,n_mount=2,n_plate=1,n_inside=1,n_pad_r=4,n_hat=2,"
    "n_h_ring=2",
    "flutter_friction": "0.4",
    "regime_time": "0.016",
    "regime_start_factor": "1",
    "regime_cycle": "on",
    "regime_cycle_steps": "128",
    "regime_cycle_range": "0.39,0.41",
    "regime_cycles_kept": "0",
    "regime_spectrum_points": "0.15,0,0;-0.15,0,0",
}


def make(program, folder):
    """Runs the case into a folder."""
    words = [word for name, value in OPTIONS.items() for word in (f"-{name}", value)]
    subprocess.run(
        [program, *words, "-report_dir", folder, "-quiet"], check=True, stdout=subprocess.DEVNULL
    )


def place(program, made, folder):
    """Puts the results into `folder`: a copy of `made`, or a run if that is None."""
    if made is None:
        make(program, folder)
    else:
        shutil.copytree(made, folder)


if __name__ == "__main__":
    shutil.rmtree(sys.argv[2], ignore_errors=True)
    make(*sys.argv[1:])
