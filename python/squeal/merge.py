"""Joins the results of several runs over parts of one grid of parameters, or lists those of variants."""
import contextlib
import json
import os
import re
import shutil
import tempfile
from pathlib import Path

import numpy as np
import pandas as pd
from scipy.spatial import cKDTree

from squeal.results import PARAMETERS, Results, ResultsError

TABLES = ("eigenvalues", "stability_map", "branches", "critical", "friction_work", "sensitivities")
NEEDED = ("eigenvalues", "stability_map")
# Options on which no number depends, and beginnings of such; those of which the program says the same (src/checkpoint) are among them.
INDIFFERENT = ("resume", "checkpoint", "checkpoint_interval", "quiet", "progress", "options_file")
INDIFFERENT_BEGINNINGS = ("report_", "log_")
SWEPT = tuple(f"flutter_{name}" for name in PARAMETERS)
SAME_NUMBER = 1e-9  # relative; of eigenvalues without an estimate of their error
SAME_CRITICAL = 1e-7  # relative; ten times -flutter_critical_tolerance by default
SAME_PLACE = 1e-9  # of nodes, in sizes of the mesh
GRAVITY = ("unstable", "undecided", "uncertified", "stable", "neutral")  # verdicts, the gravest first
LARGEST_REPORT = 8  # points named in one line


class Part:
    """The results of one run, its tables as texts: they are handed on as they are."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.results = Results(folder)
        self.summary = self.results.summary
        if "parts" in self.summary:
            raise ResultsError(f"{folder} is a merge itself: name the folders of its parts")
        if not self.summary.get("complete", True):
            raise ResultsError(f"{folder} holds no complete results: its run was interrupted")
        self.given, self.options = _recipe(self.folder / "options.txt")
        self.tables = {}
        for name in TABLES:
            path = self.folder / f"{name}.csv"
            if path.exists():
                try:
                    self.tables[name] = pd.read_csv(path, dtype=str, keep_default_na=False)
                except (OSError, ValueError) as error:
                    raise ResultsError(f"{path}: {error}") from None
            elif name in NEEDED:
                raise ResultsError(f"{path} is missing")
        self.points = _points(self.tables["stability_map"], self.folder / "stability_map.csv")

    def eigenvalues(self, point):
        """Those of a point as complex numbers, their estimated errors, and their verdicts."""
        rows = self.results.eigenvalues
        rows = rows[np.array([key == point for key in _keys(rows)], bool)]
        errors = rows["error_estimate"].to_numpy() if "error_estimate" in rows else np.full(len(rows), np.nan)
        return rows["s"].to_numpy(), np.nan_to_num(errors), rows["verdict"].to_numpy()


def merge(out, folders):
    """Writes the folder `out` with the joined results of `folders`; returns what there is to say, in lines. Raises ResultsError."""
    parts = _parts(folders)
    for part in parts[1:]:
        _require_alike(parts[0], part)
    taken, said = _owners(parts)
    tables, left = _joined_tables(parts, taken)
    said += [f"{name}.csv is not merged: {', '.join(map(str, folders))} have none" for name, folders in left.items()]
    grid = np.prod([tables["stability_map"][name].astype(float).nunique() for name in PARAMETERS])
    points = len(tables["stability_map"])
    if points < grid:
        said.append(f"{points} of the {grid} points of the grid of all values are there")
    with _new_folder(out) as new:
        for name, table in tables.items():
            table.to_csv(new / f"{name}.csv", index=False, lineterminator="\n")
        _write_summary(new, _joined_summary(parts, taken, out, left))
    said.append(f"{points} points of {len(parts)} parts in {out}; mode shapes and fields stay in the parts")
    return said


def list_variants(out, folders):
    """Writes the folder `out` with variants.csv, a row for each of `folders`; returns what there is to say, in lines."""
    parts = _parts(folders)
    known = sorted(set().union(*(part.options for part in parts)))
    differing = [name for name in known if any(_differs(name, parts[0], part) for part in parts[1:])]
    rows = [
        {"part": _from(out, part.folder), **{name: part.options.get(name, "") for name in differing}, **_outcome(part)} for part in parts
    ]
    with _new_folder(out) as new:
        pd.DataFrame(rows).to_csv(new / "variants.csv", index=False, lineterminator="\n")
        _write_summary(new, {"version": parts[0].summary.get("version", ""), "complete": True, "variants": True,
                             "options_that_differ": differing, "parts": [_entry(part, out) for part in parts]})  # fmt: skip
    return [f"{len(parts)} variants, which differ in {', '.join(differing) or 'nothing'}, in {Path(out) / 'variants.csv'}"]


def _parts(folders):
    places = [Path(folder).resolve() for folder in folders]
    for place, folder in zip(places, folders):
        if places.count(place) > 1:
            raise ResultsError(f"{folder} is named twice")
    return [Part(folder) for folder in folders]


def _recipe(path):
    """Options of a run, as options.txt keeps them: the names of those that were given, and the values of all, defaults too."""
    try:
        lines = path.read_text().splitlines()
    except OSError as error:
        raise ResultsError(f"{path}: {error.strerror}; it tells the options of the run") from None
    found = [re.fullmatch(r"(# )?-(\w+) ?(.*)", line) for line in lines[1:]]
    options = {match[2]: match[3].strip("\"'") for match in found if match}
    return {match[2] for match in found if match and not match[1]}, options


def _points(table, path):
    missing = [name for name in PARAMETERS if name not in table]
    if missing:
        raise ResultsError(f"{path}: there is no column {', '.join(missing)}")
    return _keys(table)


def _key(values):
    """Parameters in a form in which equal ones are equal, whether counted up to or written: 0.1 + 0.2 is 0.3."""
    return tuple(float(f"{float(value):.12g}") for value in values)


def _keys(table, names=PARAMETERS):
    return [_key(values) for values in zip(*(table[name] for name in names))]


def _value(text):
    """The value of an option in a form in which equal values are equal: 1.0e6 is 1e6."""
    words = []
    for word in text.split(","):
        try:
            words.append(float(word))
        except ValueError:
            words.append(word.strip())
    return tuple(words)


def _indifferent(name):
    return name in INDIFFERENT or name.startswith(INDIFFERENT_BEGINNINGS)


def _differs(name, first, part):
    """Whether an option differs. What one run has not asked for, the other may have by default."""
    if _indifferent(name):
        return False
    if name in first.options and name in part.options:
        return _value(first.options[name]) != _value(part.options[name])
    return name in first.given or name in part.given


def _require_alike(first, part):
    """Throws unless two parts differ in swept parameters alone."""

    def differ(what, one, other):
        raise ResultsError(f"{part.folder} is no part of the same grid as {first.folder}: {what}, {other} and {one}; see --variants")

    if part.summary.get("version") != first.summary.get("version"):
        differ("the version of the program differs", first.summary.get("version"), part.summary.get("version"))
    for name in sorted(first.options.keys() | part.options.keys()):
        if name in SWEPT or name == "mesh_file":
            continue
        if _differs(name, first, part):
            differ(f"-{name} differs", first.options.get(name, "none"), part.options.get(name, "none"))
    _require_same_mesh(first, part, differ)


def _require_same_mesh(first, part, differ):
    # Unknowns of a mesh depend on the nodes that are open.
    for name in ("nodes", "cells", "contact_nodes") if "nodes" in first.summary else ("dofs",):
        if first.summary.get(name) != part.summary.get(name):
            differ(f"{'the meshes' if 'nodes' in first.summary else 'they'} differ in {name}", first.summary.get(name), part.summary.get(name))
    try:
        one, other = first.results.mesh, part.results.mesh
    except ResultsError:  # -report_fields off
        one = other = None
    part.results.__dict__.pop("mesh", None)  # one large mesh is held, not all
    if one is None or other is None:
        names = [Path(each.options.get("mesh_file", "none")).name for each in (first, part)]
        if names[0] != names[1]:
            differ("-mesh_file differs", *names)
        return
    # The numbers of nodes follow the ranks; a file of the same name may have changed, and one mesh may lie in two places.
    size = np.ptp(one.coordinates, axis=0).max()
    apart = cKDTree(one.coordinates).query(other.coordinates)[0].max() if len(one.coordinates) else 0
    if apart > SAME_PLACE * size:
        differ("the meshes differ", first.options.get("mesh_file"), f"nodes up to {apart:.3g} apart in {part.options.get('mesh_file')}")
    if {kind: len(block["nodes"]) for kind, block in one.cells.items()} != {kind: len(block["nodes"]) for kind, block in other.cells.items()}:
        differ("the meshes differ in the types of their cells", first.options.get("mesh_file"), part.options.get("mesh_file"))


def _owners(parts):
    """For each part, which of its points are taken from it: all but those that an earlier part has with the same numbers."""
    taken, said, seen = [], [], {}
    for part in parts:
        fresh = set()
        for point in part.points:
            other = seen.setdefault(point, part)
            if other is part:
                fresh.add(point)
            else:
                apart = _require_same_numbers(other, part, point)
                said.append(f"the point {_words(point)} is in {other.folder} and {part.folder}, up to {apart:.1e} apart: taken once")
        taken.append(fresh)
    if len(said) > LARGEST_REPORT:
        said = [*said[:LARGEST_REPORT], f"and {len(said) - LARGEST_REPORT} more points are in two parts"]
    return taken, said


def _require_same_numbers(first, part, point):
    """Eigenvalues of one point from two runs: each is known to its estimated error, and to SAME_NUMBER at best."""
    (one, one_error, one_verdict), (other, other_error, other_verdict) = first.eigenvalues(point), part.eigenvalues(point)
    head = f"{first.folder} and {part.folder} have different results at {_words(point)}"
    if len(one) != len(other):
        raise ResultsError(f"{head}: {len(one)} and {len(other)} eigenvalues")
    scale = np.maximum(np.abs(one), np.finfo(float).tiny)
    apart = np.abs(one - other) / scale
    wrong = (apart > np.maximum(SAME_NUMBER, one_error + other_error)) | (one_verdict != other_verdict)
    if wrong.any():
        at = int(np.argmax(np.where(wrong, apart, -1)))
        raise ResultsError(f"{head}: mode {at + 1} is {one[at]:.10g} ({one_verdict[at]}) and {other[at]:.10g} ({other_verdict[at]}) 1/s")
    return apart.max(initial=0)


def _joined_tables(parts, taken):
    """The tables that all parts have, row by row as the parts have them; and the folders that lack one that others have."""
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
                piece = piece[np.array([key in fresh for key in _keys(piece)], bool)]
            pieces.append(piece)
        columns = list(pieces[0].columns)
        for part, piece in zip(parts, pieces):
            if list(piece.columns) != columns:
                raise ResultsError(f"{part.folder / name}.csv has other columns than {parts[0].folder / name}.csv")
        tables[name] = _in_order(pd.concat(pieces, ignore_index=True), name)
    return tables, left


def _in_order(table, name):
    """The rows in the order in which one run over the whole grid writes them."""
    keys = ["damping", "speed", "pressure"]
    keys += ["branch", "friction"] if name == "branches" else ["friction"]
    order = table[keys].astype(float).sort_values(keys, kind="stable").index
    return table.loc[order]


def _renumbered(parts):
    """branches.csv and critical.csv of each part. Branches are numbered along a line of equal speed, pressure and damping; where two parts
    follow the same line, the numbers of the later one go on after those of the earlier one, and no branch of one part is joined to one of
    another. Active sets are numbered through all parts; 0 stays 0. A critical friction that both parts have found is taken once."""
    last, sets, found, results = {}, 0, [], []
    for part in parts:
        made = {}
        counts = {}
        branches = part.tables.get("branches")
        critical = part.tables.get("critical")
        if branches is not None:
            for line, rows in branches.groupby(_line(branches)):
                counts[line] = int(rows["branch"].astype(int).max())
        for name, table in (("branches", branches), ("critical", critical)):
            if table is None:
                continue
            shift = pd.Series([last.get(line, 0) for line in _line(table)], index=table.index, dtype=int)
            made[name] = table.copy()
            for column in ("branch", "partner"):
                if column in table:
                    numbers = table[column].astype(int)
                    made[name][column] = numbers.where(numbers <= 0, numbers + shift).astype(str)
            numbers = table["active_set"].astype(int)
            made[name]["active_set"] = numbers.where(numbers <= 0, numbers + sets).astype(str)
        if critical is not None:
            fresh = np.array([not any(_same_critical(row, known) for known in found) for row in critical.to_dict("records")], bool)
            found += critical[fresh].to_dict("records")
            made["critical"] = made["critical"][fresh]
        for line, count in counts.items():
            last[line] = last.get(line, 0) + count
        sets += len(part.summary.get("active_sets", []))
        results.append(made)
    return results


def _line(table):
    return pd.Series(_keys(table, PARAMETERS[1:]), index=table.index, dtype=object)


def _same_critical(one, other):
    same = [one[name] == other[name] for name in ("kind", "direction")]
    same += [_key(one[name] for name in PARAMETERS[1:]) == _key(other[name] for name in PARAMETERS[1:])]
    same += [np.isclose(float(one[name]), float(other[name]), rtol=SAME_CRITICAL, atol=SAME_CRITICAL) for name in ("friction", "frequency_hz")]
    return all(same)


def _joined_summary(parts, taken, out, left):
    first = parts[0].summary
    frictions, sets = {}, []
    for number, (part, fresh) in enumerate(zip(parts, taken), 1):
        for entry in part.summary.get("frictions", []):
            point = _key(entry[name] for name in PARAMETERS)
            if point in fresh or point not in frictions:  # a point without steady sliding is in no table
                frictions[point] = {**entry, "part": number}
        sets += [{**entry, "part": number} for entry in part.summary.get("active_sets", [])]
    frictions = list(frictions.values())
    order = ("damping", "speed", "pressure", "friction")
    options = {name: value for name, value in first.get("options", {}).items() if not _indifferent(name)}
    for name in PARAMETERS:
        if f"flutter_{name}" in options:
            values = sorted({entry[name] for entry in frictions})
            options[f"flutter_{name}"] = ",".join(f"{value:.15g}" for value in values)
    shared = {name: first[name] for name in ("version", "case", "nodes", "cells", "contact_nodes", "interfaces", "method", "dofs") if name in first}
    return {
        **shared,
        "complete": all(part.summary.get("complete", True) for part in parts),
        "parts": [_entry(part, out) for part in parts],
        "branches_joined": "no: a branch ends where its part does; numbers are unique on a line of equal speed, pressure and damping",
        "not_merged": {"results.h5": "mode shapes and fields are in the parts", "modes.csv, steady_*.csv, contact_path.csv": "in the parts", **{f"{name}.csv": "not in all parts" for name in left}},
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
        "complete": summary.get("complete", True),
        "points": len(part.points),
        "swept": {name: part.options[name] for name in SWEPT if name in part.options},
        "ranks": summary.get("ranks"),
        "wall_s": summary.get("wall_s"),
        "stages": summary.get("stages", {}),
    }


def _from(out, path):
    return os.path.relpath(path, out)


def _outcome(part):
    """What became of a variant, at its worst."""
    points = part.results.stability_map
    row = {"points": len(points), "unstable_points": int((points["unstable_modes"] > 0).sum())}
    growth = points["largest_growth_rate_1_per_s"]
    worst = points.loc[growth.idxmax()] if growth.notna().any() else None
    row["worst_growth_rate_1_per_s"] = "" if worst is None else worst["largest_growth_rate_1_per_s"]
    row["worst_frequency_hz"] = "" if worst is None or "frequency_hz" not in worst else worst["frequency_hz"]
    row["worst_friction"] = "" if worst is None else worst["friction"]
    critical = part.results.critical
    lost = [] if critical is None else critical[critical["direction"] == "loss"]["friction"]
    row["critical_friction"] = min(lost, default="")
    verdicts = set(points["verdict"])
    row["verdict"] = next((verdict for verdict in GRAVITY if verdict in verdicts), "")
    return row


def _write_summary(folder, summary):
    (folder / "summary.json").write_text(json.dumps(summary, indent=2) + "\n")
    names = sorted([*(path.name for path in folder.iterdir()), "manifest.txt"])
    head = f"# squeal {summary.get('version', '')}: the {len(names)} files of a run"  # the program and scripts/results.py read it
    (folder / "manifest.txt").write_text("\n".join([head, *names]) + "\n")


@contextlib.contextmanager
def _new_folder(out):
    """A folder beside `out` that takes its place when it is complete; an earlier merge there goes then, and nothing else ever does."""
    out = Path(out)
    _require_replaceable(out)
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        new = Path(tempfile.mkdtemp(prefix=f".{out.name}.", dir=out.parent))
    except OSError as error:
        raise ResultsError(f"cannot write {out}: {error.strerror}") from None
    try:
        yield new
        new.chmod(0o777 & ~_mask())
        for path in new.iterdir():
            with path.open("rb") as file:
                os.fsync(file.fileno())
        earlier = new.with_name(new.name + ".earlier")
        if out.exists():
            out.rename(earlier)
        new.rename(out)
        shutil.rmtree(earlier, ignore_errors=True)
    except OSError as error:
        raise ResultsError(f"cannot write {out}: {error.strerror}") from None
    finally:
        shutil.rmtree(new, ignore_errors=True)


def _mask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


def _require_replaceable(out):
    if not os.path.lexists(out):
        return
    try:
        merged = "parts" in json.loads((out / "summary.json").read_text())
        listed = set((out / "manifest.txt").read_text().splitlines()[1:])
        others = sorted(path.name for path in out.iterdir() if path.name not in listed)
    except (OSError, ValueError):
        merged, others = False, []
    if not merged:
        raise ResultsError(f"{out} exists and is no merge: name another folder, or move it")
    if others:
        raise ResultsError(f"{out} holds a file that no merge has written, {others[0]}: move it")


def _words(point):
    values = dict(zip(PARAMETERS, point))
    return ", ".join(f"{name} {value:g}" for name, value in values.items() if name == "friction" or value != 1)


__all__ = ["list_variants", "merge"]
