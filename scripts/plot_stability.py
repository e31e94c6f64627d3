#!/usr/bin/env python3
"""Plots frequency and growth rate of every mode against friction, and the critical friction against speed.

plot_stability.py REPORT_DIR reads REPORT_DIR/eigenvalues.csv and writes REPORT_DIR/stability.png; for a sweep over speeds one
stability_speed_SPEED.png each, and critical_friction.png. Eigenvalues above the band, which nobody vouches for, are left out.
"""
import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

HEADER = (
    "friction,speed,pressure,damping,mode,growth_rate_1_per_s,angular_frequency_rad_per_s,frequency_hz,damping_ratio,backward_error,in_band"
).split(",")
UNSTABLE = 1e-6  # a growth rate is taken for positive above this fraction of |s|; below it is round-off


def read_eigenvalues(path):
    """Columns of the table by name."""
    with open(path, newline="") as file:
        rows = csv.reader(file)
        header = next(rows, [])
        if header != HEADER:
            raise ValueError(f"{path}: the header must be\n{','.join(HEADER)}\nnot\n{','.join(header)}")
        values = np.array([[float(x) for x in row] for row in rows if row]).reshape(-1, len(HEADER))
    return dict(zip(HEADER, values.T))


def within_band(table):
    """The rows that the program vouches for."""
    return {name: column[table["in_band"] == 1] for name, column in table.items()}


def roundoff_of(table):
    """Growth rates that mean nothing."""
    return UNSTABLE * np.hypot(table["growth_rate_1_per_s"], table["angular_frequency_rad_per_s"])


def draw(table):
    friction, growth = table["friction"], table["growth_rate_1_per_s"]
    roundoff = roundoff_of(table)
    unstable = growth > roundoff
    kilo = np.max(table["frequency_hz"], initial=0) >= 2000
    frequency = table["frequency_hz"] / (1000 if kilo else 1)

    figure, (upper, lower) = plt.subplots(2, 1, sharex=True, figsize=(9, 9), height_ratios=(2, 1), layout="constrained")
    colours = dict(c=growth[unstable], cmap="plasma_r", vmin=0, zorder=3, edgecolors="black", linewidths=0.3)
    for axes, value in ((upper, frequency), (lower, growth)):
        axes.scatter(friction[~unstable], value[~unstable], s=5, color="0.55", linewidths=0, label="stable")
        if unstable.any():
            marks = axes.scatter(friction[unstable], value[unstable], s=30, label="unstable", **colours)
        axes.grid(color="0.92")
        axes.set_axisbelow(True)
    if unstable.any():
        figure.colorbar(marks, ax=[upper, lower], label="growth rate of the unstable modes [1/s]", aspect=50, pad=0.02)

    upper.set_title(summary(friction, unstable))
    upper.set_ylabel(f"frequency [{'kHz' if kilo else 'Hz'}]")
    upper.set_ylim(bottom=0)
    lower.set_ylabel("growth rate [1/s]")
    lower.axhline(0, color="black", linewidth=0.6)
    lower.set_xlabel("friction coefficient [-]")
    if np.ptp(friction) == 0:  # one value: give the axis a width
        lower.set_xlim(friction[0] - 0.05, friction[0] + 0.05)
    if np.all(np.abs(growth) <= roundoff):
        lower.set_ylim(-1, 1)  # no axis in units of round-off
    upper.legend(loc="upper center", bbox_to_anchor=(0.5, 0), ncols=2, frameon=False)
    return figure


def summary(friction, unstable):
    modes, values = len(friction), len(np.unique(friction))
    text = f"{modes} eigenvalues at {values} friction value{'s' if values != 1 else ''}: "
    if not unstable.any():
        return text + "all stable"
    return text + f"{np.count_nonzero(unstable)} unstable, from friction {np.min(friction[unstable]):g} on"


def draw_critical(table):
    """The first unstable friction of the sweep at each speed; the bar reaches down to the last stable one below it."""
    figure, axes = plt.subplots(figsize=(9, 5), layout="constrained")
    unstable = table["growth_rate_1_per_s"] > roundoff_of(table)
    frictions = np.unique(table["friction"])
    for speed in np.unique(table["speed"]):
        at_speed = table["speed"] == speed
        critical = table["friction"][at_speed & unstable]
        if len(critical):
            first = np.min(critical)
            below = np.max(frictions[frictions < first], initial=0)
            axes.errorbar(speed, first, [[first - below], [0]], fmt="o", color="C3", capsize=3)
        else:
            axes.plot(speed, np.max(frictions), "^", color="C0")
    axes.plot([], [], "o", color="C3", label="first unstable friction of the sweep, down to the last stable one")
    axes.plot([], [], "^", color="C0", label="stable up to this friction")
    axes.set_xscale("log")
    axes.set_ylim(0, 1.1 * np.max(frictions))
    axes.set_xlabel("speed factor [-]")
    axes.set_ylabel("critical friction [-]")
    axes.grid(color="0.92")
    axes.legend(frameon=False)
    return figure


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: plot_stability.py REPORT_DIR")
    folder = Path(sys.argv[1])
    try:
        table = within_band(read_eigenvalues(folder / "eigenvalues.csv"))
    except (OSError, ValueError) as error:
        sys.exit(f"plot_stability: {error}")
    if len(table["friction"]) == 0:
        sys.exit(f"plot_stability: {folder / 'eigenvalues.csv'} holds no eigenvalue")
    speeds = np.unique(table["speed"])
    for speed in speeds:
        name = "stability.png" if len(speeds) == 1 else f"stability_speed_{speed:g}.png"
        draw({key: column[table["speed"] == speed] for key, column in table.items()}).savefig(folder / name, dpi=150)
    if len(speeds) > 1:
        draw_critical(table).savefig(folder / "critical_friction.png", dpi=150)


if __name__ == "__main__":
    main()
