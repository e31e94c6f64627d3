# SPDX-License-Identifier: BSD-2-Clause
"""Draws the motion after flutter: growth, spectrum and state of the contact nodes."""
import argparse

import numpy as np
from matplotlib.figure import Figure

from squeal.files import ResultsError
from squeal.folder import Folder
from squeal.regime import KEYS, UNMEASURED
from squeal.results import Results


def run_asked(table, start):
    if start is not None:
        table = table[table["start"].astype(str) == start]
    measured = table[table["class"] != UNMEASURED]
    return None if table.empty else table.iloc[0] if measured.empty else measured.iloc[0]


def rows_of(table, run):
    return table[np.logical_and.reduce([table[key] == run[key] for key in KEYS])]


def plane_of(points):
    """Returns the coordinates of the points along their two longest directions, for a nearly
    flat surface, and the names of these axes."""
    centred = points - points.mean(axis=0)
    spread = np.ptp(centred, axis=0)
    axes = sorted(np.argsort(spread)[-2:])
    return centred[:, axes], ["xyz"[axis] for axis in axes]


def draw_growth(axes, cycles, run):
    axes.semilogy(1e3 * cycles["time_s"], cycles["largest_kinetic_energy_j"], color="C0", lw=1)
    axes.axhline(
        run["onset_kinetic_energy_j"],
        color="0.5",
        ls="--",
        lw=1,
        label="first node opens or comes to rest",
    )
    axes.set(xlabel="time, ms", ylabel="largest kinetic energy of a cycle, J")
    axes.legend(fontsize=8)


def draw_spectrum(axes, spectrum, run):
    top = 4 * run["flutter_frequency_hz"]
    shown = spectrum[(spectrum["frequency_hz"] > 0) & (spectrum["frequency_hz"] < top)]
    axes.semilogy(
        1e-3 * shown["frequency_hz"], shown["velocity_sqrt_kg_m_per_s"], color="C0", lw=0.8
    )
    axes.axvline(
        1e-3 * run["flutter_frequency_hz"], color="C1", ls="--", lw=1, label="flutter mode"
    )
    axes.set(xlabel="frequency, kHz", ylabel="velocity, √kg m/s")
    axes.legend(fontsize=8)


def draw_nodes(figure, places, nodes):
    points, names = plane_of(nodes[["x_m", "y_m", "z_m"]].to_numpy())
    for axes, column in zip(places, ("open", "stick", "slip")):
        drawn = axes.scatter(*(1e3 * points.T), c=100 * nodes[column], s=18, cmap="cividis", vmin=0)
        figure.colorbar(drawn, ax=axes, shrink=0.8)
        axes.set(
            aspect="equal",
            xlabel=f"{names[0]}, mm",
            ylabel=f"{names[1]}, mm",
            title=f"{column}, % of the time",
        )


def title_of(run):
    words = f"friction {run['friction']:g}, start on mode {run['start']}: {run['class']}"
    if not run["settled"]:
        words += ", not settled"
    return (
        words
        + f"; carrier {run['carrier_hz']:.6g} Hz, flutter {run['flutter_frequency_hz']:.6g} Hz"
    )


def tables_of(results):
    """Returns the tables that are drawn, by the ends of their names."""
    folder = results.folder
    if results.table("regime") is None:
        raise ResultsError(
            f"{folder} has no regime.csv: no motion after flutter was computed (-regime_friction)"
        )
    tables = {
        name: results.table(f"regime{name}") for name in ("", "_nodes", "_cycles", "_spectrum")
    }
    missing = next((name for name, table in tables.items() if table is None), None)
    if missing:
        raise ResultsError(f"{folder / f'regime{missing}.csv'} is missing")
    return tables


def draw(results, start=None):
    """Draws the first run that has measured anything, or the run with this start."""
    tables = tables_of(results)
    run = run_asked(tables[""], start)
    if run is None:
        which = "" if start is None else f" of start {start}"
        raise ResultsError(f"regime.csv of {results.folder} has no run{which}")
    if run["class"] == UNMEASURED:
        raise ResultsError(
            f"friction {run['friction']:g}, start on mode {run['start']}: {UNMEASURED}, and there"
            " is nothing to draw"
        )
    figure = Figure(figsize=(12, 8.5), layout="constrained")
    upper, lower = figure.subfigures(2, 1, height_ratios=(1, 1.2))
    growth, spectrum = upper.subplots(1, 2)
    draw_growth(growth, rows_of(tables["_cycles"], run), run)
    draw_spectrum(spectrum, rows_of(tables["_spectrum"], run), run)
    nodes = rows_of(tables["_nodes"], run)
    if not nodes.empty:
        draw_nodes(lower, lower.subplots(1, 3), nodes)
    figure.suptitle(title_of(run))
    return figure


def main(words):
    parser = argparse.ArgumentParser(
        prog="squeal-plot regime", description="Draws the motion after flutter."
    )
    parser.add_argument("report_dir", metavar="DIR")
    parser.add_argument("start", nargs="?", metavar="START")
    arguments = parser.parse_args(words)
    folder = Folder(arguments.report_dir)
    print(folder.save("regime.png", draw(Results(arguments.report_dir), arguments.start), dpi=110))
