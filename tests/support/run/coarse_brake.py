#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The disc brake on a coarse mesh at four frictions: coarse_brake.py PROGRAM FOLDER runs it. The
tests of the report read it from copies of FOLDER; without one they make the run themselves."""
from made_run import MadeRun

RUN = MadeRun(
    "disc_brake",
    {
        "modes_count": "60",
        "mesh_set": "n_pad_theta=8,n_free_theta=12,n_mount=2,n_plate=1,n_inside=1,n_pad_r=4,"
        "n_hat=2,n_h_ring=2",
        "flutter_friction": "0,0.2,0.4,0.6",
        "flutter_sensitivities": "on",
    },
)

if __name__ == "__main__":
    RUN.main()
