# SPDX-License-Identifier: BSD-2-Clause
"""The motion after flutter, for the report."""
import math

import numpy as np

from squeal.keys import PARAMETERS

KEYS = [*PARAMETERS, "start"]
MOST_POINTS = 2000  # of a line in a diagram
SHOWN_TO = 4  # times the frequency of the flutter mode
UNMEASURED = "nothing measured"
KINDS = {
    UNMEASURED: "was not measured",
    "growing": "still grows",
    "steady": "dies away",
    "periodic": "becomes periodic",
    "modulated": "becomes modulated",
    "irregular": "becomes irregular",
}
# Columns of the map of the contact nodes: column, title, unit, factor.
NODES = [
    ("open", "open", "% of the time", 100),
    ("stick", "sticking", "% of the time", 100),
    ("slip", "sliding", "% of the time", 100),
    ("mean_pressure_pa", "mean pressure", "Pa", 1),
    ("largest_gap_m", "largest gap", "m", 1),
    ("friction_power_w", "heat of friction", "W", 1),
]


def sentences(results):
    """Returns one sentence on each run of regime.csv."""
    table = results.table("regime")
    return [] if table is None else [_sentence(results, run) for run in table.to_dict("records")]


def _sentence(results, run):
    others = "".join(
        f", {name} {run[name]:g}" for name in PARAMETERS[1:] if name in results.swept()
    )
    kind = KINDS.get(run["class"], run["class"])
    start = (
        "the sum of all unstable modes" if str(run["start"]) == "all" else f"mode {run['start']}"
    )
    text = f"At friction {run['friction']:g}{others} the motion from {start} {kind}"
    if not run["settled"] and run["class"] not in ("growing", "steady", UNMEASURED):
        text += ", not settled when the run ended"
    said = []
    if _known(run["carrier_hz"]):
        said.append(
            f"carrier {run['carrier_hz']:.6g} Hz (flutter {run['flutter_frequency_hz']:.6g} Hz)"
        )
    if _known(run["modulation_hz"]):
        said.append(f"modulation {run['modulation_hz']:.3g} Hz")
    if _known(run["open_nodes"]):
        said.append(
            f"{100 * run['open_nodes'] / run['contact_nodes']:.2g} % of the contact nodes open"
        )
    if _known(run.get("sound_power_estimate_w")):
        said.append(
            f"estimated sound power {run['sound_power_estimate_w']:.2g} W,"
            f" {run['sound_power_level_db']:.0f} dB re 1e-12 W"
        )
    return text + (": " + ", ".join(said) if said else "") + "."


def _known(value):
    return value is not None and math.isfinite(value)


def diagrams(results):
    """Returns growth, spectrum and contact nodes of each run of regime.csv; an empty list
    without such runs."""
    table = results.table("regime")
    if table is None:
        return []
    tables = {name: results.table(f"regime_{name}") for name in ("cycles", "spectrum", "nodes")}
    tables |= {name: results.table(name) for name in ("periodic", "periodic_branch")}
    runs = []
    for run, sentence in zip(table.to_dict("records"), sentences(results)):
        rows = {name: _rows_of(part, run) for name, part in tables.items()}
        runs.append(
            {
                "name": f"friction {run['friction']:g}, start {run['start']}",
                "sentence": " ".join(
                    [sentence, *_periodic_sentences(rows["periodic"], rows["periodic_branch"])]
                ),
                "onset": _number(run["onset_kinetic_energy_j"]),
                "flutter": _number(run["flutter_frequency_hz"]),
                "cycles": _line(rows["cycles"], "time_s", "largest_kinetic_energy_j"),
                "spectrum": _spectrum(rows["spectrum"], run),
                "nodes": _nodes(rows["nodes"]),
                "periodic": _motions(rows["periodic"]),
            }
        )
    return runs


def _periodic_sentences(motions, ways):
    """Returns sentences on the periodic motions."""
    if motions is None or motions.empty:
        return []
    first = motions.iloc[0]
    if not first["converged"]:
        return ["No periodic motion was found near it."]
    kind = "stable" if first["stable"] else "unstable, so that the march swings about it"
    said = [
        f"A periodic motion of {first['frequency_hz']:.6g} Hz is {kind} (largest Floquet multiplier"
        f" {first['largest_multiplier']:.4g})."
    ]
    folds = [] if ways is None else ways["fold_friction"].dropna().tolist()
    if folds:
        said.append(
            f"The branch of such motions turns back at friction {min(folds):.4g}: vibration that"
            " has begun can stay down to there."
        )
    return said


def _motions(table):
    """Returns the periodic motions: friction, largest kinetic energy, stable or not, frequency."""
    if table is None:
        return []
    table = table[table["converged"] == 1]
    return [
        [
            float(row["motion_friction"]),
            float(row["largest_kinetic_energy_j"]),
            bool(row["stable"]),
            float(row["frequency_hz"]),
        ]
        for row in table.to_dict("records")
    ]


def _rows_of(table, run):
    if table is None:
        return None
    return table[np.logical_and.reduce([table[key] == run[key] for key in KEYS])]


def _number(value):
    return float(value) if _known(value) else None


def _line(table, x, y):
    """Returns at most MOST_POINTS points of a line: the largest of each group of neighbours, so
    that peaks stay. Values that are not positive have no place on a logarithmic axis."""
    if table is None or y not in table:
        return []
    xs, ys = table[x].to_numpy(float), table[y].to_numpy(float)
    drawn = np.isfinite(ys) & (ys > 0)
    xs, ys = xs[drawn], ys[drawn]
    group = max(1, math.ceil(len(xs) / MOST_POINTS))
    best = [begin + int(np.argmax(ys[begin : begin + group])) for begin in range(0, len(xs), group)]
    return [[float(xs[i]), float(ys[i])] for i in best]


def _spectrum(table, run):
    """Returns lines by title: the mass-weighted velocity of all nodes, and the normal velocity
    at each point."""
    if table is None:
        return {}
    table = table[
        (table["frequency_hz"] > 0)
        & (table["frequency_hz"] < SHOWN_TO * run["flutter_frequency_hz"])
    ]
    lines = {"all of the brake, √kg m/s": "velocity_sqrt_kg_m_per_s"}
    for number in range(1, 1 + sum(name.endswith("_normal_m_per_s") for name in table)):
        lines[f"normal velocity at point {number}, m/s"] = f"velocity_{number}_normal_m_per_s"
    return {title: _line(table, "frequency_hz", column) for title, column in lines.items()}


def _nodes(table):
    """Returns the places in the plane of the two longest directions, in mm, and the values by
    title and unit."""
    if table is None or table.empty:
        return None
    points = table[["x_m", "y_m", "z_m"]].to_numpy(float)
    axes = sorted(np.argsort(np.ptp(points, axis=0), kind="stable")[-2:])
    values = [
        {
            "title": title,
            "unit": unit,
            "values": [_number(factor * value) for value in table[column]],
        }
        for column, title, unit, factor in NODES
        if column in table
    ]
    return {
        "axes": ["xyz"[axis] for axis in axes],
        "places": (1e3 * points[:, axes]).tolist(),
        "fields": values,
    }


__all__ = ["diagrams", "sentences"]
