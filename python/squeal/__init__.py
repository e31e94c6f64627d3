# SPDX-License-Identifier: BSD-2-Clause
"""Results of squeal, the program for brake squeal: pandas tables, modes and contact fields as numpy
arrays and VTK grids.

    import squeal
    run = squeal.open("results/disc_brake")
    run.eigenvalues.query("verdict == 'unstable'")
    mode = run.fastest_mode(friction=0.4)
    grid = mode.grid(phase=0.5)
"""
from squeal.files import ResultsError
from squeal.keys import PARAMETERS

__all__ = ["PARAMETERS", "Mode", "Results", "ResultsError", "open"]


def __getattr__(name):
    """Imports numpy, pandas and h5py when a program first opens results: a command can then report
    which of them is missing."""
    if name in ("Mode", "Results", "open"):
        from squeal import results

        return getattr(results, name)
    raise AttributeError(f"module 'squeal' has no attribute '{name}'")
