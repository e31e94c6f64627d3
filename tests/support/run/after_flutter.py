#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The coarse disc brake after flutter, with periodic motions: after_flutter.py PROGRAM FOLDER runs
it. The tests of tables and of its report read it from copies of FOLDER; without one they make the
run themselves."""
from made_run import MadeRun

RUN = MadeRun(
    "disc_brake_regime",
    {
        "modes_count": "60",
        "flutter_band": "9000",
        "mesh_set": "n_pad_theta=8,n_free_theta=12,n_mount=2,n_plate=1,n_inside=1,n_pad_r=4,"
        "n_hat=2,n_h_ring=2",
        "flutter_friction": "0.4",
        "regime_time": "0.016",
        "regime_start_factor": "1",
        "regime_cycle": "on",
        "regime_cycle_steps": "128",
        "regime_cycle_range": "0.39,0.41",
        "regime_cycles_kept": "0",
        "regime_spectrum_points": "0.15,0,0;-0.15,0,0",
    },
)

if __name__ == "__main__":
    RUN.main()
