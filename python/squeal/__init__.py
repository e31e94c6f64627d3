"""Results of squeal, the program for brake squeal: tables as pandas, modes and contact fields as numpy arrays and VTK grids.

    import squeal
    run = squeal.open("results/disc_brake")
    run.eigenvalues.query("verdict == 'unstable'")
    mode = run.fastest_mode(friction=0.4)
    grid = mode.grid(phase=0.5)
"""
from squeal.files import ResultsError
from squeal.keys import PARAMETERS
from squeal.results import Mode, Results, open  # noqa: A004

__all__ = ["PARAMETERS", "Mode", "Results", "ResultsError", "open"]
