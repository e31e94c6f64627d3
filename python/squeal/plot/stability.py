# SPDX-License-Identifier: BSD-2-Clause
"""Draws what a sweep has found.

stability.png: frequency, growth rate and damping ratio of every mode against the friction, or
against the parameter that was swept instead; one figure for each value of the other swept
parameters: stability_speed_3.png, … If branches.csv and critical.csv are there, it shows lines
along the branches, the critical frictions, and the intervals of the active sets, every second one
shaded. stability_map.png, if two or more parameters were swept: largest growth rate over two of
them, the stable region, and the critical friction; one figure for each value of the other
parameters: stability_map_damping_2.png, … Eigenvalues above the band are not certified and not
drawn.
"""
import sys

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

from squeal.files import ResultsError
from squeal.folder import Folder
from squeal.results import NOISE, Results

READABLE = 300  # cells of a map that have room for a number
LABELS = {
    "friction": "friction coefficient [-]",
    "speed": "speed factor [-]",
    "pressure": "pressure factor [-]",
    "damping": "damping factor [-]",
}


def slices(table, names):
    """Returns for each combination of values of the parameters `names` a suffix for file names,
    a title, and the values."""
    if not names:
        return [("", "", {})]
    return [
        (
            "".join(f"_{name}_{value:g}" for name, value in zip(names, values)),
            ", ".join(f"{name} {value:g}" for name, value in zip(names, values)),
            dict(zip(names, values)),
        )
        for values in table[names].drop_duplicates().sort_values(names).to_numpy()
    ]


def at(table, values):
    """Returns the rows of a table with these values of parameters."""
    selected = np.ones(len(table), bool)
    for name, value in values.items():
        selected &= table[name] == value
    return table[selected]


def lines_and_sets(branches):
    """Returns the rows of each branch by ascending friction, and the ends of the active sets in
    order."""
    # Where contact changes, a branch has two rows at the same friction, in the order of the table.
    lines = [rows.sort_values("friction", kind="stable") for _, rows in branches.groupby("branch")]
    # Set 0 means all sets between two points.
    friction = branches[branches["active_set"] != 0].groupby("active_set")["friction"]
    return lines, sorted(zip(friction.min(), friction.max()))


def damping_percent(table):
    """Returns the damping ratio −Re s/|s| of each row in %; negative for growing modes."""
    growth, omega = np.asarray(table["growth_rate_1_per_s"], float), 2 * np.pi * np.asarray(
        table["frequency_hz"], float
    )
    size = np.hypot(growth, omega)
    return -100 * np.divide(growth, size, out=np.zeros_like(growth), where=size > 0)


def draw_followed(upper, lower, bottom, scale, followed):
    """Draws lines along the branches, the critical frictions, and shades every second active
    set."""
    branches, critical = followed
    lines, ends = lines_and_sets(branches[branches["in_band"] > 0])
    for line in lines:
        style = dict(color="0.7", linewidth=0.6, zorder=1)
        upper.plot(line["friction"], line["frequency_hz"] / scale, **style)
        lower.plot(line["friction"], line["growth_rate_1_per_s"], **style)
        bottom.plot(line["friction"], damping_percent(line), **style)
    for low, high in ends[1::2]:
        for axes in (upper, lower, bottom):
            axes.axvspan(low, high, color="#eef3fa", zorder=0)
    for loss, marker, label in ((True, "x", "stability is lost"), (False, "+", "and regained")):
        chosen = critical[(critical["direction"] == "loss") == loss]
        if len(chosen):
            upper.plot(
                chosen["friction"],
                chosen["frequency_hz"] / scale,
                marker,
                color="black",
                markersize=6,
                markeredgewidth=0.9,
                zorder=4,
                label=label,
            )


def draw_modes(table, name, title, followed=None):
    """Draws frequency, growth rate and damping ratio of every mode against the parameter `name`,
    with branches and critical frictions."""
    table = {column: values.to_numpy() for column, values in table.items()}
    abscissa, growth = table[name], table["growth_rate_1_per_s"]
    grows, open_ = table["grows"], table["verdict"] == "undecided"
    kilo = np.max(table["frequency_hz"], initial=0) >= 2000
    scale = 1000 if kilo else 1
    frequency = table["frequency_hz"] / scale

    figure = Figure(figsize=(9, 11), layout="constrained")
    upper, lower, bottom = figure.subplots(3, 1, sharex=True, height_ratios=(2.2, 1, 1))
    colours = dict(
        c=growth[grows], cmap="plasma_r", vmin=0, zorder=3, edgecolors="black", linewidths=0.3
    )
    for axes, value in ((upper, frequency), (lower, growth), (bottom, damping_percent(table))):
        calm = ~(grows | open_)
        axes.scatter(
            abscissa[calm],
            value[calm],
            s=5,
            color="0.55",
            linewidths=0,
            label=calm_label(table["verdict"][calm]),
        )
        if open_.any():
            axes.scatter(
                abscissa[open_],
                value[open_],
                s=20,
                facecolors="none",
                edgecolors="0.3",
                linewidths=0.8,
                label="undecided",
            )
        if grows.any():
            certain = "unstable" in table["verdict"]
            marks = axes.scatter(
                abscissa[grows],
                value[grows],
                s=30,
                label="unstable" if certain else "growing, uncertified",
                **colours,
            )
        axes.grid(color="0.92")
        axes.set_axisbelow(True)
    if followed:
        draw_followed(upper, lower, bottom, scale, followed)
    if grows.any():
        figure.colorbar(
            marks,
            ax=[upper, lower, bottom],
            label="growth rate of the unstable modes [1/s]",
            aspect=50,
            pad=0.02,
        )

    upper.set_title(
        (f"{title}: " if title else "") + summary(abscissa, grows, name, table["verdict"])
    )
    upper.set_ylabel(f"frequency [{'kHz' if kilo else 'Hz'}]")
    upper.set_ylim(bottom=0)
    lower.set_ylabel("growth rate [1/s]")
    bottom.set_ylabel("damping ratio [%]")
    for axes in (lower, bottom):
        axes.axhline(0, color="black", linewidth=0.6)
    bottom.set_xlabel(LABELS[name])
    if np.ptp(abscissa) == 0:  # one value: give the axis a width
        lower.set_xlim(abscissa[0] - 0.05, abscissa[0] + 0.05)
    scale_axis(lower.xaxis, name, abscissa)
    if np.all(np.abs(growth) <= NOISE * np.abs(table["s"])):
        lower.set_ylim(-1, 1)  # no axis in units of round-off
        bottom.set_ylim(-1, 1)
    upper.legend(loc="upper center", bbox_to_anchor=(0.5, 0), ncols=4, frameon=False)
    return figure


def calm_label(verdicts):
    """Returns a label for the eigenvalues that neither grow nor are undecided."""
    words = [word for word in ("stable", "neutral", "uncertified") if word in verdicts]
    return " or ".join(words) or "stable"


def summary(abscissa, grows, name, verdicts):
    modes, values = len(abscissa), len(np.unique(abscissa))
    text = f"{modes} eigenvalues at {values} {name} value{'s' if values != 1 else ''}: "
    text += f"{np.count_nonzero(grows)} unstable" if grows.any() else "none unstable"
    if name == "friction" and grows.any():
        text += f", from friction {np.min(abscissa[grows]):g} on"
    for word in ("undecided", "uncertified"):
        if word in verdicts:
            text += f", {np.count_nonzero(verdicts == word)} {word}"
    return text


def logarithmic(name, values):
    return name != "friction" and np.min(values) > 0 and np.max(values) >= 10 * np.min(values)


def scale_axis(axis, name, values):
    """Makes an axis logarithmic if its values span a decade, with ticks at the values: a sweep
    has few powers of ten."""
    if logarithmic(name, values):
        axis.axes.set(**{f"{axis.axis_name}scale": "log"})
        axis.set_ticks(np.unique(values), [f"{value:g}" for value in np.unique(values)])
        axis.set_ticks([], minor=True)


def cell_borders(name, values):
    """Returns the borders of the cells around the values of an axis, half-way between the
    values."""
    if len(values) == 1:  # parts of the grid are missing
        return values[0] + np.array([-0.5, 0.5]) * (abs(values[0]) or 1)
    places = np.log(values) if logarithmic(name, values) else values
    middle = (places[1:] + places[:-1]) / 2
    borders = np.concatenate(([2 * places[0] - middle[0]], middle, [2 * places[-1] - middle[-1]]))
    return np.exp(borders) if logarithmic(name, values) else borders


def axes_of_map(table, swept):
    """Returns the two swept parameters of the map, across and up: friction goes up, the
    parameter with the most values across."""
    up = swept[0]
    across = max(swept[1:], key=lambda name: len(np.unique(table[name])))
    return across, up


def grid_of(table, across, up, name):
    """Returns the values of column `name` as [up][across]; NaN where there are none."""
    x, x_index = np.unique(table[across], return_inverse=True)
    y, y_index = np.unique(table[up], return_inverse=True)
    grid = np.full((len(y), len(x)), np.nan)
    grid[y_index, x_index] = table[name]
    return x, y, grid


def critical(y, unstable_modes):
    """Returns the last stable and the first unstable value of one column of the map; None if the
    column is stable or unstable all the way."""
    known = ~np.isnan(unstable_modes)
    grows = known & (np.nan_to_num(unstable_modes) > 0)
    if not grows.any():
        return None
    first = np.argmax(grows)
    below = np.flatnonzero(known[:first])
    return (y[below[-1]], y[first]) if len(below) else None


def draw_map(table, across, up, title, largest):
    x, y, growth = grid_of(table, across, up, "largest_growth_rate_1_per_s")
    _, _, modes = grid_of(table, across, up, "unstable_modes")
    figure = Figure(figsize=(9, 6), layout="constrained")
    axes = figure.subplots()
    borders = cell_borders(across, x), cell_borders(up, y)
    axes.set_facecolor("white")
    axes.pcolormesh(*borders, np.where(modes == 0, 0.0, np.nan), cmap=ListedColormap(["#dcebdc"]))
    grows = np.where(modes > 0, growth, np.nan)
    if np.any(modes > 0):
        cells = axes.pcolormesh(*borders, grows, cmap="plasma_r", vmin=0, vmax=largest)
        figure.colorbar(cells, label="largest growth rate [1/s]", aspect=40, pad=0.02)
    for row, column in np.argwhere(modes > 0) if modes.size <= READABLE else ():
        colour = "white" if growth[row, column] > 0.5 * largest else "black"
        beside = dict(xytext=(9, 0), textcoords="offset points", ha="center", va="center")
        axes.annotate(
            f"{modes[row, column]:.0f}", (x[column], y[row]), fontsize=7, color=colour, **beside
        )
    for row, column in np.argwhere(np.isnan(modes)):
        axes.annotate(
            "no steady\nsliding",
            (x[column], y[row]),
            ha="center",
            va="center",
            fontsize=7,
            color="0.5",
        )
    if up == "friction":
        marks = [(value, critical(y, modes[:, column])) for column, value in enumerate(x)]
        marks = [(value, *limits) for value, limits in marks if limits]
        if marks:
            place, low, high = np.array(marks).T
            axes.errorbar(
                place,
                (low + high) / 2,
                (high - low) / 2,
                fmt="o-",
                color="black",
                markersize=4,
                linewidth=1,
                capsize=3,
                label="critical friction: between the last stable and the first unstable one",
            )
    axes.plot([], [], "s", color="#dcebdc", label="stable")
    scale_axis(axes.xaxis, across, x)
    scale_axis(axes.yaxis, up, y)
    axes.set_xlabel(LABELS[across])
    axes.set_ylabel(LABELS[up])
    axes.set_title(
        (f"{title}: " if title else "") + "largest growth rate, and how many modes are unstable"
    )
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=2, frameon=False)
    return figure


def figures(results):
    """Yields the name and the figure of each picture."""
    table, stability = results.eigenvalues, results.stability_map
    followed = None if results.branches is None else (results.branches, results.critical)
    if len(table) == 0:
        raise ResultsError(f"{results.folder / 'eigenvalues.csv'} holds no eigenvalue")
    swept = results.swept()
    abscissa = swept[0] if swept else "friction"
    for suffix, title, values in slices(table, swept[1:]):
        lines = (
            tuple(at(rows, values) for rows in followed)
            if followed and abscissa == "friction"
            else None
        )
        yield f"stability{suffix}.png", draw_modes(at(table, values), abscissa, title, lines)
    if len(swept) < 2:
        return
    across, up = axes_of_map(stability, swept)
    largest = max(0, stability["largest_growth_rate_1_per_s"].max())
    for suffix, title, values in slices(
        stability, [name for name in swept if name not in (across, up)]
    ):
        yield f"stability_map{suffix}.png", draw_map(
            at(stability, values), across, up, title, largest
        )


def main(words):
    if len(words) != 1 or words[0].startswith("-"):
        sys.exit("usage: squeal-plot [stability] DIR")
    folder = Folder(words[0])
    for name, figure in figures(Results(words[0])):
        folder.save(name, figure, dpi=150)
