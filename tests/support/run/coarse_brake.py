#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The disc brake on a coarse mesh at four frictions: coarse_brake.py PROGRAM FOLDER runs it. The
tests of the report read it from copies of FOLDER; without one they make the run themselves."""
import shutil
import subprocess
import sys
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[3]
OPTIONS = {
    "options_file": REPOSITORY / "options/disc_brake.yaml",
    "modes_count": "60",
    "mesh_set": "n_pad_theta=8,n_free_theta=12,n_mount=2,n_plate=1,n_inside=1,n_pad_r=4,n_hat=2,"
    "n_h_ring=2",
    "flutter_friction": "0,0.2,0.4,0.6",
    "flutter_sensitivities": "on",
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
