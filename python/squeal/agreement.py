# SPDX-License-Identifier: BSD-2-Clause
"""Checks that the tables of a run agree with each other and with summary.json.

A table that has lost its end looks like the table of a run with fewer points, and a wrong word
may be another word of the schema.
"""
import collections

import numpy as np

from squeal.files import ResultsError
from squeal.keys import PARAMETERS, key_of, words_of


def require_agreement(folder, summary, tables):
    """Raises ResultsError if two tables of a run, or a table and the summary, differ."""
    points = {
        key_of(point[name] for name in PARAMETERS): point for point in summary.get("frictions", [])
    }
    if "eigenvalues" in tables:
        _require_eigenvalues(folder / "eigenvalues.csv", tables["eigenvalues"], points)
        _require_growth(folder / "eigenvalues.csv", tables["eigenvalues"], summary)
    if "stability_map" in tables:
        _require_map(folder / "stability_map.csv", tables["stability_map"], points)
    if "critical" in tables:
        _require_directions(folder / "critical.csv", tables["critical"])
    if "regime" in tables and "regimes" in summary:
        _require_classes(folder / "regime.csv", tables["regime"], summary["regimes"])
    if "referee" in tables and "referee" in summary:
        _require_judgement(folder / "referee.csv", tables["referee"], summary["referee"])


def _differ(path, at, found, listed):
    return ResultsError(
        f"{path}: it has {found} at {words_of(dict(zip(PARAMETERS, at)))}, summary.json lists"
        f" {listed}"
    )


def _keys(table):
    return list(map(key_of, table[list(PARAMETERS)].to_numpy()))


def _require_eigenvalues(path, table, points):
    keys = _keys(table)
    there, words = collections.Counter(keys), collections.Counter(zip(keys, table["verdict"]))
    for key, point in points.items():
        if there[key] != point.get("eigenvalues", 0):
            cut = " is cut" if there[key] < point.get("eigenvalues", 0) else ""
            raise ResultsError(
                f"{path}{cut}: it has {there[key]} rows at {words_of(dict(zip(PARAMETERS, key)))},"
                f" summary.json lists {point.get('eigenvalues', 0)}"
            )
        for word, count in point.get("verdicts", {}).items():
            if words[key, word] != count:
                raise _differ(path, key, f"{words[key, word]} eigenvalues that are {word}", count)
    if points:
        _require_known(path, keys, points)


def _require_known(path, keys, points):
    unknown = next((number for number, key in enumerate(keys, 2) if key not in points), None)
    if unknown:
        raise ResultsError(
            f"{path}, line {unknown}: summary.json does not list this point of the sweep"
        )


def _require_growth(path, table, summary):
    """Requires that unstable eigenvalues grow, and that stable ones grow by no more than
    -flutter_unstable_tolerance."""
    growth, size = table["growth_rate_1_per_s"], np.hypot(
        table["growth_rate_1_per_s"], table["angular_frequency_rad_per_s"]
    )
    least = float(summary.get("options", {}).get("flutter_unstable_tolerance", "0"))
    wrong = ((table["verdict"] == "unstable") & (growth <= 0)) | (
        (table["verdict"] == "stable") & (growth > least * size)
    )
    if wrong.any():
        at = int(np.argmax(wrong.to_numpy()))
        raise ResultsError(
            f"{path}, line {at + 2}: an eigenvalue of growth {growth.iloc[at]:g} 1/s is called"
            f" {table['verdict'].iloc[at]}"
        )


def _require_map(path, table, points):
    keys = _keys(table)
    there = collections.Counter(keys)
    twice = (
        next((number for number, key in enumerate(keys, 2) if key in keys[: number - 2]), None)
        if len(there) < len(keys)
        else None
    )
    if twice:
        raise ResultsError(f"{path}, line {twice}: the point is there twice")
    for key, point in points.items():
        if "eigenvalues" in point and not there[key]:
            raise ResultsError(
                f"{path} is cut: it has 0 rows at {words_of(dict(zip(PARAMETERS, key)))},"
                " summary.json lists 1"
            )
    if points:
        _require_known(path, keys, points)
        for key, row in zip(keys, table.to_dict("records")):
            point = points[key]
            if "verdict" in point and row["verdict"] != point["verdict"]:
                raise _differ(path, key, f"the verdict {row['verdict']}", point["verdict"])
            if "unstable_modes" in point and row["unstable_modes"] != len(point["unstable_modes"]):
                raise _differ(
                    path,
                    key,
                    f"{row['unstable_modes']:g} unstable modes",
                    len(point["unstable_modes"]),
                )


def _require_directions(path, table):
    """Requires that the slope (docs/results.md) is positive where stability is lost, and
    negative where it is regained."""
    if not {"slope", "converged"} <= set(table):
        return
    solved = (table["kind"] != "contact") & (table["converged"] == 1)
    wrong = solved & (
        ((table["direction"] == "loss") & (table["slope"] < 0))
        | ((table["direction"] == "regain") & (table["slope"] > 0))
    )
    # There is no smaller friction at which it could have been lost.
    wrong |= solved & (table["direction"] == "regain") & (table["friction"] == 0)
    if wrong.any():
        at = int(np.argmax(wrong.to_numpy()))
        raise ResultsError(
            f"{path}, line {at + 2}: {table['direction'].iloc[at]} of stability, with the slope"
            f" {table['slope'].iloc[at]:g}"
        )


def _require_classes(path, table, runs):
    if len(table) != len(runs):
        raise ResultsError(
            f"{path} is cut: it has {len(table)} rows, summary.json lists {len(runs)}"
        )
    for number, (row, entry) in enumerate(zip(table.to_dict("records"), runs), 2):
        if (row["class"], row["start"]) != (entry["class"], entry["start"]):
            raise ResultsError(
                f"{path}, line {number}: start {row['start']} is {row['class']}, summary.json lists"
                f" {entry['start']}, {entry['class']}"
            )


def _require_judgement(path, table, judgement):
    found = collections.Counter(table["verdict"])
    for word, count in judgement["verdicts"].items():
        if found[word] != count:
            raise ResultsError(
                f"{path}: it has {found[word]} entries that are {word}, summary.json lists {count}"
            )


__all__ = ["require_agreement"]
