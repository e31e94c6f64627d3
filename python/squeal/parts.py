# SPDX-License-Identifier: BSD-2-Clause
"""Reads the parts of a merge (runs over parts of one grid of parameters) and compares them."""
import re
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

from squeal.files import ResultsError, read_text
from squeal.keys import PARAMETERS, key_of
from squeal.results import Results
from squeal.schema import TABLES as SCHEMA

# Tables that a merge joins: each of their rows is of one point or of one critical friction.
TABLES = (
    "eigenvalues",
    "stability_map",
    "proof",
    "branches",
    "critical",
    "critical_sensitivities",
    "friction_work",
    "components",
    "participation",
    "participation_bodies",
    "sensitivities",
)
NEEDED = ("eigenvalues", "stability_map")
# Options that change no number, and beginnings of their names. They include those that the program
# ignores when it resumes a run (src/base/checkpoint).
INDIFFERENT = (
    "audit",
    "resume",
    "checkpoint",
    "checkpoint_interval",
    "quiet",
    "progress",
    "options_file",
)
INDIFFERENT_BEGINNINGS = ("report_", "log_")
SWEPT = tuple(f"flutter_{name}" for name in PARAMETERS)
SAME_NUMBER = 1e-9  # relative; of eigenvalues without an estimate of their error
SAME_PLACE = 1e-9  # of nodes, in sizes of the mesh
LARGEST_REPORT = 8  # points named in one line


class Part:
    """The results of one run. Its tables are texts, so that the merge writes the same digits."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.results = Results(folder)
        self.summary = self.results.summary
        if "parts" in self.summary:
            raise ResultsError(f"{folder} is a merge itself: name the folders of its parts")
        if not self.summary["complete"]:
            raise ResultsError(f"{folder} holds no complete results: its run was interrupted")
        self.given, self.options = recipe_of(self.folder / "options.txt")
        self.tables = {
            name: self.results.texts[name] for name in TABLES if name in self.results.texts
        }
        self.others = [_file_of(name) for name in self.results.texts if name not in TABLES]
        for name in NEEDED:
            if name not in self.tables:
                raise ResultsError(f"{self.folder / name}.csv is missing")
        self.points = keys_of(self.results.stability_map)
        solved = sum(
            len(line.get("critical_frictions", []))
            for entry in self.summary.get("active_sets", [])
            for line in entry.get("followed", [])
        )
        if "critical" in self.tables and len(self.tables["critical"]) < solved:
            raise ResultsError(
                f"{self.folder / 'critical.csv'} is cut: it has"
                f" {len(self.tables['critical'])} rows, summary.json lists {solved}"
            )

    def eigenvalues(self, point):
        """Returns the eigenvalues of a point as complex numbers, their estimated errors, and
        their verdicts."""
        rows = self.results.eigenvalues
        rows = rows[np.array([key == point for key in keys_of(rows)], bool)]
        errors = (
            rows["error_estimate"].to_numpy()
            if "error_estimate" in rows
            else np.full(len(rows), np.nan)
        )
        return rows["s"].to_numpy(), np.nan_to_num(errors), rows["verdict"].to_numpy()


def _file_of(name):
    """Returns the file name of a table; tables of single points share one name with a `*`."""
    kind, point, _ = name.partition("_")
    return f"{kind}_*.csv" if name not in SCHEMA and point else f"{name}.csv"


def read_parts(folders, out):
    """The runs in `folders`. None of these folders may contain `out`, the folder of the merge: a
    later run into such a folder would remove it."""
    places = [Path(folder).resolve() for folder in folders]
    for place, folder in zip(places, folders):
        if places.count(place) > 1:
            raise ResultsError(f"{folder} is named twice")
        if place in Path(out).resolve().parents:
            raise ResultsError(f"{out} is inside {folder}, one of its parts: name a folder outside")
    return [Part(folder) for folder in folders]


def recipe_of(path):
    """Returns the options in options.txt: the names of those that were given, and the values of
    all, including defaults."""
    try:
        lines = read_text(path).splitlines()
    except FileNotFoundError:
        raise ResultsError(f"{path} is missing; it lists the options of the run") from None
    found = [re.fullmatch(r"(# )?-(\w+) ?(.*)", line) for line in lines[1:]]
    options = {match[2]: match[3].strip("\"'") for match in found if match}
    return {match[2] for match in found if match and not match[1]}, options


def keys_of(table, names=PARAMETERS):
    return [key_of(values) for values in zip(*(table[name] for name in names))]


def _value(text):
    """Returns the value of an option in a form in which equal values are equal: 1.0e6 is 1e6."""
    words = []
    for word in text.split(","):
        try:
            words.append(float(word))
        except ValueError:
            words.append(word.strip())
    return tuple(words)


def indifferent(name):
    return name in INDIFFERENT or name.startswith(INDIFFERENT_BEGINNINGS)


def differs(name, first, part):
    """Returns whether an option differs. If only one run lists it, it differs only if that run
    gave it, since defaults are the same."""
    if indifferent(name):
        return False
    if name in first.options and name in part.options:
        return _value(first.options[name]) != _value(part.options[name])
    return name in first.given or name in part.given


def require_alike(first, part):
    """Raises ResultsError if two parts differ in more than swept parameters."""

    def differ(what, one, other):
        raise ResultsError(
            f"{part.folder} is not part of the same grid as {first.folder}: {what}, {other} and"
            f" {one}; see --variants"
        )

    if part.summary.get("version") != first.summary.get("version"):
        differ(
            "the version of the program differs",
            first.summary.get("version"),
            part.summary.get("version"),
        )
    for name in sorted(first.options.keys() | part.options.keys()):
        if name in SWEPT or name == "mesh_file":
            continue
        if differs(name, first, part):
            differ(
                f"-{name} differs", first.options.get(name, "none"), part.options.get(name, "none")
            )
    _require_same_mesh(first, part, differ)


def _require_same_mesh(first, part, differ):
    # The number of unknowns of a mesh depends on the open nodes.
    for name in ("nodes", "cells", "contact_nodes") if "nodes" in first.summary else ("dofs",):
        if first.summary.get(name) != part.summary.get(name):
            differ(
                f"{'the meshes' if 'nodes' in first.summary else 'they'} differ in {name}",
                first.summary.get(name),
                part.summary.get(name),
            )
    try:
        one, other = first.results.mesh, part.results.mesh
    except ResultsError:  # -report_fields off
        one = other = None
    part.results.__dict__.pop("mesh", None)  # only one large mesh stays in memory
    if one is None or other is None:
        names = [Path(each.options.get("mesh_file", "none")).name for each in (first, part)]
        if names[0] != names[1]:
            differ("-mesh_file differs", *names)
        return
    # The numbering of the nodes depends on the ranks. A file of the same name may have changed, and
    # there may be two copies of one mesh.
    size = np.ptp(one.coordinates, axis=0).max()
    apart = (
        cKDTree(one.coordinates).query(other.coordinates)[0].max() if len(one.coordinates) else 0
    )
    if apart > SAME_PLACE * size:
        differ(
            "the meshes differ",
            first.options.get("mesh_file"),
            f"nodes up to {apart:.3g} apart in {part.options.get('mesh_file')}",
        )
    if {kind: len(block["nodes"]) for kind, block in one.cells.items()} != {
        kind: len(block["nodes"]) for kind, block in other.cells.items()
    }:
        differ(
            "the meshes differ in the types of their cells",
            first.options.get("mesh_file"),
            part.options.get("mesh_file"),
        )


def owners_of(parts):
    """Returns for each part the points that the merge takes from it (those that no earlier part
    has), and messages on repeated points. Raises ResultsError if their results differ."""
    taken, said, seen = [], [], {}
    for part in parts:
        fresh = set()
        for point in part.points:
            other = seen.setdefault(point, part)
            if other is part:
                fresh.add(point)
            else:
                apart = _require_same_numbers(other, part, point)
                said.append(
                    f"the point {_words(point)} is in {other.folder} and {part.folder}, up to"
                    f" {apart:.1e} apart: taken once"
                )
        taken.append(fresh)
    if len(said) > LARGEST_REPORT:
        said = [
            *said[:LARGEST_REPORT],
            f"and {len(said) - LARGEST_REPORT} more points are in two parts",
        ]
    return taken, said


def _require_same_numbers(first, part, point):
    """Requires that two runs have the same eigenvalues at a point, to within their estimated errors
    or, if these are smaller, SAME_NUMBER. Returns the largest relative difference."""
    (one, one_error, one_verdict), (other, other_error, other_verdict) = first.eigenvalues(
        point
    ), part.eigenvalues(point)
    head = f"{first.folder} and {part.folder} have different results at {_words(point)}"
    if len(one) != len(other):
        raise ResultsError(f"{head}: {len(one)} and {len(other)} eigenvalues")
    scale = np.maximum(np.abs(one), np.finfo(float).tiny)
    apart = np.abs(one - other) / scale
    wrong = (apart > np.maximum(SAME_NUMBER, one_error + other_error)) | (
        one_verdict != other_verdict
    )
    if wrong.any():
        at = int(np.argmax(np.where(wrong, apart, -1)))
        raise ResultsError(
            f"{head}: mode {at + 1} is {one[at]:.10g} ({one_verdict[at]}) and"
            f" {other[at]:.10g} ({other_verdict[at]}) 1/s"
        )
    return apart.max(initial=0)


def _words(point):
    values = dict(zip(PARAMETERS, point))
    return ", ".join(
        f"{name} {value:g}" for name, value in values.items() if name == "friction" or value != 1
    )


__all__ = [
    "SAME_NUMBER",
    "SWEPT",
    "TABLES",
    "differs",
    "indifferent",
    "keys_of",
    "owners_of",
    "read_parts",
    "recipe_of",
    "require_alike",
]
