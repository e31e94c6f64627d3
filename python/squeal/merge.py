# SPDX-License-Identifier: BSD-2-Clause
"""Joins the results of several runs over parts of one grid of parameters, or lists variants."""
import argparse
import json
import os
import signal
import sys
from pathlib import Path

import numpy as np
import pandas as pd

from squeal.files import ResultsError
from squeal.folder import new_folder, read_manifest, write_manifest
from squeal.keys import PARAMETERS, key_of
from squeal.parts import (
    SWEPT,
    TABLES,
    differs,
    indifferent,
    keys_of,
    owners_of,
    read_parts,
    require_alike,
)
from squeal.schema import VERDICTS as GRAVITY
from squeal.summary import read_summary

FOLLOWED = ("branches", "critical", "critical_sensitivities")
CRITICAL = ("active_set", "branch", "partner", "kind", "direction", *PARAMETERS)
SAME_CRITICAL = 1e-7  # relative; ten times -flutter_critical_tolerance by default


def merge(out, folders):
    """Writes the folder `out` with the joined results of `folders`. Returns messages, one per
    line. Raises ResultsError."""
    parts = read_parts(folders, out)
    for part in parts[1:]:
        require_alike(parts[0], part)
    taken, said = owners_of(parts)
    tables, left = _joined_tables(parts, taken)
    said += [
        f"{name}.csv is not merged: {', '.join(map(str, folders))} have none"
        for name, folders in left.items()
    ]
    others = _other_files(parts)
    if others:
        said.append(f"tables that stay in the parts and are not merged: {', '.join(others)}")
    grid = np.prod([tables["stability_map"][name].astype(float).nunique() for name in PARAMETERS])
    points = len(tables["stability_map"])
    if points < grid:
        said.append(f"{points} of the {grid} points of the grid of all values are there")
    _require_replaceable(out)
    with new_folder(out) as new:
        for name, table in tables.items():
            table.to_csv(new / f"{name}.csv", index=False, lineterminator="\n")
        shapes = {
            name: {"rows": len(table), "columns": list(table.columns)}
            for name, table in tables.items()
        }
        _write_summary(new, {**_joined_summary(parts, taken, out, left), "tables": shapes})
    said.append(
        f"{points} points of {len(parts)} parts in {out}; mode shapes and fields stay in the parts"
    )
    return said


def list_variants(out, folders):
    """Writes the folder `out` with variants.csv, which has a row for each of `folders`. Returns
    messages, one per line."""
    parts = read_parts(folders, out)
    known = sorted(set().union(*(part.options for part in parts)))
    differing = [name for name in known if any(differs(name, parts[0], part) for part in parts[1:])]
    rows = [
        {
            "part": _from(out, part.folder),
            **{name: part.options.get(name, "") for name in differing},
            **_outcome(part),
        }
        for part in parts
    ]
    _require_replaceable(out)
    with new_folder(out) as new:
        pd.DataFrame(rows).to_csv(new / "variants.csv", index=False, lineterminator="\n")
        _write_summary(
            new,
            {
                "version": parts[0].summary.get("version", ""),
                "complete": True,
                "variants": True,
                "options_that_differ": differing,
                "parts": [_entry(part, out) for part in parts],
            },
        )
    return [
        f"{len(parts)} variants, which differ in {', '.join(differing) or 'nothing'}, in"
        f" {Path(out) / 'variants.csv'}"
    ]


def _joined_tables(parts, taken):
    """Returns the tables that all parts have, and for each table that only some have, the
    folders without it."""
    left = {}
    for name in TABLES:
        without = [part.folder for part in parts if name not in part.tables]
        if without and len(without) < len(parts):
            left[name] = without
    tables = {}
    numbered = _renumbered(parts)
    for name in TABLES:
        if any(name not in part.tables for part in parts):
            continue
        pieces = []
        for part, fresh, lines in zip(parts, taken, numbered):
            piece = lines.get(name, part.tables[name])
            if name not in lines:
                piece = piece[np.array([key in fresh for key in keys_of(piece)], bool)]
            pieces.append(piece)
        columns = list(pieces[0].columns)
        for part, piece in zip(parts, pieces):
            if list(piece.columns) != columns:
                raise ResultsError(
                    f"{part.folder / name}.csv has other columns than {parts[0].folder / name}.csv"
                )
        tables[name] = _in_order(pd.concat(pieces, ignore_index=True), name)
    return tables, left


def _other_files(parts):
    """Returns the files of the tables that no merge joins."""
    return sorted(set().union(*(part.others for part in parts)))


def _in_order(table, name):
    """Sorts the rows as one run over the whole grid would write them."""
    keys = ["damping", "speed", "pressure"]
    keys += ["branch", "friction"] if name == "branches" else ["friction"]
    order = table[keys].astype(float).sort_values(keys, kind="stable").index
    return table.loc[order]


def _renumbered(parts):
    """Renumbers the branches and active sets in the tables of branches and critical frictions of
    each part.

    Branches are numbered along a line of equal speed, pressure and damping. If two parts follow
    the same line, the numbers of the later part continue those of the earlier one; branches of
    different parts are not joined. Active sets are numbered through all parts; 0 stays 0. A
    critical friction that both parts have found appears once, with its derivatives.
    """
    last, sets, found, results = {}, 0, [], []
    for part in parts:
        tables = {name: part.tables[name] for name in FOLLOWED if name in part.tables}
        made = {name: _shifted(table, last, sets) for name, table in tables.items()}
        critical = tables.get("critical")
        if critical is not None:
            rows = critical.to_dict("records")
            new = [not any(_same_critical(row, known) for known in found) for row in rows]
            found += [row for row, is_new in zip(rows, new) if is_new]
            made["critical"] = made["critical"][np.array(new, bool)]
            if "critical_sensitivities" in made:
                dropped = {_critical_key(row) for row, is_new in zip(rows, new) if not is_new}
                derivatives = tables["critical_sensitivities"].to_dict("records")
                kept = [_critical_key(row) not in dropped for row in derivatives]
                made["critical_sensitivities"] = made["critical_sensitivities"][
                    np.array(kept, bool)
                ]
        if "branches" in tables:
            for line, lines in tables["branches"].groupby(_line(tables["branches"])):
                last[line] = last.get(line, 0) + int(lines["branch"].astype(int).max())
        sets += len(part.summary.get("active_sets", []))
        results.append(made)
    return results


def _shifted(table, last, sets):
    """Returns a table with new numbers: branches continue after the `last` number of their line,
    and active sets after the number `sets`."""
    made = table.copy()
    shift = pd.Series([last.get(line, 0) for line in _line(table)], index=table.index, dtype=int)
    for column, by in (("branch", shift), ("partner", shift), ("active_set", sets)):
        if column in table:
            numbers = table[column].astype(int)
            made[column] = numbers.where(numbers <= 0, numbers + by).astype(str)
    return made


def _line(table):
    return pd.Series(keys_of(table, PARAMETERS[1:]), index=table.index, dtype=object)


def _critical_key(row):
    """Returns the cells by which critical_sensitivities.csv refers to a row of critical.csv."""
    return tuple(row.get(name) for name in CRITICAL)


def _same_critical(one, other):
    same = [one[name] == other[name] for name in ("kind", "direction")]
    same += [
        key_of(one[name] for name in PARAMETERS[1:])
        == key_of(other[name] for name in PARAMETERS[1:])
    ]
    same += [
        np.isclose(float(one[name]), float(other[name]), rtol=SAME_CRITICAL, atol=SAME_CRITICAL)
        for name in ("friction", "frequency_hz")
    ]
    return all(same)


def _joined_summary(parts, taken, out, left):
    first = parts[0].summary
    frictions, sets = {}, []
    for number, (part, fresh) in enumerate(zip(parts, taken), 1):
        for entry in part.summary.get("frictions", []):
            point = key_of(entry[name] for name in PARAMETERS)
            # A point without steady sliding is in no table.
            if point in fresh or point not in frictions:
                frictions[point] = {**entry, "part": number}
        sets += [{**entry, "part": number} for entry in part.summary.get("active_sets", [])]
    frictions = list(frictions.values())
    order = ("damping", "speed", "pressure", "friction")
    options = {
        name: value for name, value in first.get("options", {}).items() if not indifferent(name)
    }
    for name in PARAMETERS:
        if f"flutter_{name}" in options:
            values = sorted({entry[name] for entry in frictions})
            options[f"flutter_{name}"] = ",".join(f"{value:.15g}" for value in values)
    shared = {
        name: first[name]
        for name in (
            "version",
            "case",
            "nodes",
            "cells",
            "contact_nodes",
            "interfaces",
            "supports",
            "loads",
            "references",
            "couplings",
            "equations",
            "springs",
            "bushings",
            "masses",
            "bolts",
            "method",
            "dofs",
        )
        if name in first
    }
    return {
        **shared,
        "complete": all(part.summary["complete"] for part in parts),
        "parts": [_entry(part, out) for part in parts],
        "branches_joined": (
            "no: a branch ends where its part does; numbers are unique on a line of equal speed,"
            " pressure and damping"
        ),
        "not_merged": {
            "results.h5": "mode shapes and fields are in the parts",
            **dict.fromkeys(_other_files(parts), "in the parts"),
            **{f"{name}.csv": "not in all parts" for name in left},
        },
        "frictions": sorted(frictions, key=lambda entry: [entry[name] for name in order]),
        "active_sets": sets,
        "wall_s": sum(part.summary.get("wall_s", 0) for part in parts),
        "options": options,
    }


def _entry(part, out):
    summary = part.summary
    return {
        "folder": _from(out, part.folder),
        "recipe": _from(out, part.folder / "options.txt"),
        "complete": summary["complete"],
        "points": len(part.points),
        "swept": {name: part.options[name] for name in SWEPT if name in part.options},
        "ranks": summary.get("ranks"),
        "wall_s": summary.get("wall_s"),
        "stages": summary.get("stages", {}),
    }


def _from(out, path):
    return os.path.relpath(path, out)


def _outcome(part):
    """Returns the worst results of a variant."""
    points = part.results.stability_map
    row = {"points": len(points), "unstable_points": int((points["unstable_modes"] > 0).sum())}
    growth = points["largest_growth_rate_1_per_s"]
    worst = points.loc[growth.idxmax()] if growth.notna().any() else None
    row["worst_growth_rate_1_per_s"] = "" if worst is None else worst["largest_growth_rate_1_per_s"]
    row["worst_frequency_hz"] = (
        "" if worst is None or "frequency_hz" not in worst else worst["frequency_hz"]
    )
    row["worst_friction"] = "" if worst is None else worst["friction"]
    critical = part.results.critical
    lost = (
        []
        if critical is None
        else critical[(critical["direction"] == "loss") & (critical["converged"] == 1)]["friction"]
    )
    row["critical_friction"] = min(lost, default="")
    verdicts = set(points["verdict"])
    row["verdict"] = next((verdict for verdict in GRAVITY if verdict in verdicts), "")
    return row


def _write_summary(folder, summary):
    (folder / "summary.json").write_text(json.dumps(summary, indent=2) + "\n")
    write_manifest(folder, summary.get("version", ""))


def _require_replaceable(out):
    """Raises ResultsError unless `out` is free, or holds an earlier merge and nothing else."""
    out = Path(out)
    if not os.path.lexists(out):
        return
    try:
        merged = "parts" in read_summary(out / "summary.json")
        listed = read_manifest(out) or []
        others = sorted(path.name for path in out.iterdir() if path.name not in listed)
    except (OSError, ValueError, ResultsError):
        merged, others = False, []
    if not merged:
        raise ResultsError(f"{out} exists and is not a merge: name another folder, or move it")
    if others:
        raise ResultsError(f"{out} holds {others[0]}, which no merge has written: move it")


HELP = """squeal-merge [--variants] OUT DIR...: joins the results of several runs.

The folders DIR hold the results of runs over parts of one grid of parameters. The new folder OUT
holds summary.json and the tables that all parts have; squeal-plot, squeal-report and squeal.open()
read it. Mode shapes, fields and tables that have more than rows of points and critical frictions
stay in the parts; the command names these tables. The parts may differ only in -flutter_friction,
_speed, _pressure and _damping.
--variants: the parts may differ in any option. OUT holds variants.csv, with a row for each part and
a column for each option that differs.
The command replaces an earlier merge in OUT and refuses to replace anything else.
"""


def main(words):
    parser = argparse.ArgumentParser(
        prog="squeal-merge", description=HELP, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--variants", action="store_true", help="list variants of a case")
    parser.add_argument("out", metavar="OUT")
    parser.add_argument("folders", metavar="DIR", nargs="+")
    arguments = parser.parse_args(words)
    # The exception lets new_folder() remove its folder.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    join = list_variants if arguments.variants else merge
    for line in join(arguments.out, arguments.folders):
        print(f"merge: {line}")


__all__ = ["list_variants", "main", "merge"]
