#!/usr/bin/python3 -B
"""Picture of the motion after flutter: plot_regime.py REPORT_DIR [START]

Draws regime.png of the first run of regime.csv that has measured anything, or of that with this START: the largest kinetic energy of each cycle from growth to the
regime, the spectrum of the velocity, and what share of the time each contact node is open, sticks and slides.
"""
import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python"))

from results import Results, program  # noqa: E402, I001
import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import squeal  # noqa: E402

KEYS = ["friction", "speed", "pressure", "damping", "start"]


UNMEASURED = "nothing measured"


def run_asked(table, start):
    if start is not None:
        table = table[table["start"].astype(str) == start]
    measured = table[table["class"] != UNMEASURED]
    return None if table.empty else table.iloc[0] if measured.empty else measured.iloc[0]


def rows_of(table, run):
    return table[np.logical_and.reduce([table[key] == run[key] for key in KEYS])]


def plane_of(points):
    """Two coordinates of points on a surface that is nearly flat: along its two longest directions."""
    centred = points - points.mean(axis=0)
    spread = np.ptp(centred, axis=0)
    axes = sorted(np.argsort(spread)[-2:])
    return centred[:, axes], ["xyz"[axis] for axis in axes]


def draw_growth(axes, cycles, run):
    axes.semilogy(1e3 * cycles["time_s"], cycles["largest_kinetic_energy_j"], color="C0", lw=1)
    axes.axhline(run["onset_kinetic_energy_j"], color="0.5", ls="--", lw=1, label="first node opens or comes to rest")
    axes.set(xlabel="time, ms", ylabel="largest kinetic energy of a cycle, J")
    axes.legend(fontsize=8)


def draw_spectrum(axes, spectrum, run):
    top = 4 * run["flutter_frequency_hz"]
    shown = spectrum[(spectrum["frequency_hz"] > 0) & (spectrum["frequency_hz"] < top)]
    axes.semilogy(1e-3 * shown["frequency_hz"], shown["velocity_sqrt_kg_m_per_s"], color="C0", lw=0.8)
    axes.axvline(1e-3 * run["flutter_frequency_hz"], color="C1", ls="--", lw=1, label="flutter mode")
    axes.set(xlabel="frequency, kHz", ylabel="velocity, √kg m/s")
    axes.legend(fontsize=8)


def draw_nodes(figure, places, nodes):
    points, names = plane_of(nodes[["x_m", "y_m", "z_m"]].to_numpy())
    for axes, column in zip(places, ("open", "stick", "slip")):
        drawn = axes.scatter(*(1e3 * points.T), c=100 * nodes[column], s=18, cmap="cividis", vmin=0)
        figure.colorbar(drawn, ax=axes, shrink=0.8)
        axes.set(aspect="equal", xlabel=f"{names[0]}, mm", ylabel=f"{names[1]}, mm", title=f"{column}, % of the time")


def title_of(run):
    words = f"friction {run['friction']:g}, start on mode {run['start']}: {run['class']}"
    if not run["settled"]:
        words += ", not settled"
    return words + f"; carrier {run['carrier_hz']:.6g} Hz, flutter {run['flutter_frequency_hz']:.6g} Hz"


def tables_of(folder):
    """The tables that are drawn, by the ends of their names."""
    try:
        found = squeal.open(folder)
        if found.table("regime") is None:
            sys.exit(f"{program()}: {folder} has no regime.csv: nothing was followed after flutter (-regime_friction)")
        tables = {name: found.table(f"regime{name}") for name in ("", "_nodes", "_cycles", "_spectrum")}
    except squeal.ResultsError as error:
        sys.exit(f"{program()}: {error}")
    missing = next((name for name, table in tables.items() if table is None), None)
    if missing:
        sys.exit(f"{program()}: {folder / f'regime{missing}.csv'} is missing")
    return tables


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition(":")[0])
    parser.add_argument("report_dir")
    parser.add_argument("start", nargs="?")
    arguments = parser.parse_args()
    results = Results(arguments.report_dir)
    tables = tables_of(results.folder)
    run = run_asked(tables[""], arguments.start)
    if run is None:
        which = "" if arguments.start is None else f" of start {arguments.start}"
        sys.exit(f"{program()}: regime.csv of {results.folder} has no run{which}")
    if run["class"] == UNMEASURED:
        sys.exit(f"{program()}: friction {run['friction']:g}, start on mode {run['start']}: {UNMEASURED}, and there is nothing to draw")
    figure = plt.figure(figsize=(12, 8.5), layout="constrained")
    upper, lower = figure.subfigures(2, 1, height_ratios=(1, 1.2))
    growth, spectrum = upper.subplots(1, 2)
    draw_growth(growth, rows_of(tables["_cycles"], run), run)
    draw_spectrum(spectrum, rows_of(tables["_spectrum"], run), run)
    nodes = rows_of(tables["_nodes"], run)
    if not nodes.empty:
        draw_nodes(lower, lower.subplots(1, 3), nodes)
    figure.suptitle(title_of(run))
    results.save("regime.png", figure, dpi=110)
    print(results.folder / "regime.png")


if __name__ == "__main__":
    main()
