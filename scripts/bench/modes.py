# SPDX-License-Identifier: BSD-2-Clause
"""Called by scripts/bench/modes: the free modes by SciPy, and the comparison of all runs."""
import csv
import json
import pathlib
import statistics
import sys
import time

import numpy as np

COUNT, TOLERANCE = 200, 1e-8


def by_scipy(matrices, result):
    """Shift-invert ARPACK with CHOLMOD's supernodal factorisation, through cvxopt."""
    import cvxopt
    import cvxopt.cholmod
    import scipy.io
    import scipy.sparse
    import scipy.sparse.linalg

    stiffness, mass = (
        scipy.io.mmread(matrices / f"{name}.mtx").tocsc() for name in ("stiffness", "mass")
    )
    lower = scipy.sparse.tril(stiffness).tocoo()
    started = time.perf_counter()
    cvxopt.cholmod.options["supernodal"] = 2
    matrix = cvxopt.spmatrix(
        lower.data, lower.row.astype(int), lower.col.astype(int), stiffness.shape
    )
    factor = cvxopt.cholmod.symbolic(matrix)
    cvxopt.cholmod.numeric(matrix, factor)
    factorised = time.perf_counter()

    def solve(b):
        x = cvxopt.matrix(np.asarray(b, dtype=float).reshape(-1))
        cvxopt.cholmod.solve(factor, x)
        return np.array(x).reshape(-1)

    inverse = scipy.sparse.linalg.LinearOperator(stiffness.shape, matvec=solve, dtype=float)
    squares = scipy.sparse.linalg.eigsh(
        stiffness, COUNT, mass, sigma=0, OPinv=inverse, tol=TOLERANCE, return_eigenvectors=True
    )[0]
    ended = time.perf_counter()
    json.dump(
        {
            "factor": factorised - started,
            "modes": ended - factorised,
            "omega": np.sqrt(np.sort(squares)).tolist(),
        },
        open(result, "w"),
    )


def read(folder):
    stages = json.load(open(folder / "summary.json"))["stages"]
    with open(folder / "modes.csv", newline="") as file:
        omega = [float(row["angular_frequency_rad_per_s"]) for row in csv.DictReader(file)]
    return {
        "factor": stages["factor"]["wall_s"],
        "modes": stages["modes"]["wall_s"],
        "omega": omega,
    }


def compare(results, repeats, names):
    runs = {name: [read(results / f"{name}_{i}") for i in range(1, repeats + 1)] for name in names}
    runs["SciPy with CHOLMOD, no count"] = [
        json.load(open(results / f"scipy_{i}.json")) for i in range(1, repeats + 1)
    ]
    seconds = {
        name: [run["factor"] + run["modes"] for run in list_] for name, list_ in runs.items()
    }
    reference = np.array(runs[names[0]][0]["omega"])
    print(
        "| solver | all runs: factorisation and modes, s | median, s | over the first | largest"
        " difference of a frequency |"
    )
    print("|---|---|---:|---:|---:|")
    for name, list_ in runs.items():
        apart = max(np.max(np.abs(np.array(run["omega"]) / reference - 1)) for run in list_)
        ratio = statistics.median(b / a for a, b in zip(seconds[names[0]], seconds[name]))
        times = ", ".join(f"{value:.2f}" for value in seconds[name])
        print(
            f"| {name} | {times} | {statistics.median(seconds[name]):.2f} | {ratio:.2f} |"
            f" {apart:.0e} |"
        )


if sys.argv[1] == "scipy":
    by_scipy(pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]))
else:
    compare(pathlib.Path(sys.argv[2]), int(sys.argv[3]), sys.argv[4:])
