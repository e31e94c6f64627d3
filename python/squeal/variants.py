# SPDX-License-Identifier: BSD-2-Clause
"""Variants of one brake: their common points and band, what differs, and which is quietest."""
import os
from pathlib import Path

import numpy as np
import pandas as pd

from squeal.files import ResultsError
from squeal.keys import PARAMETERS, key_of, words_of
from squeal.mac import shared_rows
from squeal.matching import unstable
from squeal.pairs import common_tops, tops_of
from squeal.parts import SAME_NUMBER, differs, recipe_of
from squeal.results import Results

DOUBTS = ("undecided", "uncertified")
# Name of a criterion, and whether the larger value is the quieter one.
CRITERIA = {
    "largest growth rate": False,
    "number of unstable modes": False,
    "critical friction": True,
}
KNOWN = 1e-5  # relative; a larger error of a critical friction is shown as a range


class Variant:
    """The complete results of one run or merge, and its options."""

    def __init__(self, folder, name):
        self.name, self.folder = name, Path(folder)
        self.results = Results(folder)
        summary = self.results.summary
        if not summary["complete"]:
            raise ResultsError(f"{folder} holds no complete results: its run was interrupted")
        if self.results.parts:  # a merge has no recipe of its own
            self.options = {key: str(value) for key, value in summary.get("options", {}).items()}
            self.given = set(self.options)
        else:
            self.given, self.options = recipe_of(self.folder / "options.txt")
        if "mesh_file" in self.options:  # a merge keeps the path as the case has it
            self.options["mesh_file"] = os.path.normpath(self.options["mesh_file"])
        self.tops = tops_of(self.results)

    def within(self, tops):
        """Returns the eigenvalues at common points and in the common band."""
        table = self._at_common_points(tops)
        return table[table["inside"]]

    def above(self, tops):
        """Returns the eigenvalues at common points above the common band."""
        table = self._at_common_points(tops)
        return table[~table["inside"]]

    def _at_common_points(self, tops):
        """The column `counts` is true for unstable modes, and for those that may be: doubt gives
        none an advantage."""
        table = self.results.eigenvalues
        points = [key_of(values) for values in table[list(PARAMETERS)].to_numpy()]
        top = np.array([tops.get(point, np.nan) for point in points])
        s = table["s"].to_numpy()
        counts = table["grows"] | (table["verdict"] == "undecided")
        counts |= (table["verdict"] == "uncertified") & unstable(s)
        inside = np.abs(s) <= 2 * np.pi * top * (1 + 1e-12)
        return table.assign(point=points, counts=counts, inside=inside)[~np.isnan(top)]


def read_variants(folders):
    """Returns the variants in some folders, named after these. Raises ResultsError if results are
    damaged or incomplete, or if nothing can be compared."""
    if len(folders) < 2:
        raise ResultsError("name at least two folders of results to compare")
    places = [Path(folder).resolve() for folder in folders]
    for place, folder in zip(places, folders):
        if places.count(place) > 1:
            raise ResultsError(f"{folder} is named twice")
    short = [place.name for place in places]
    clear = all(short.count(name) == 1 and name for name in short)
    variants = [
        Variant(folder, name)
        for folder, name in zip(folders, short if clear else map(str, folders))
    ]
    for variant in variants[1:]:
        if not common_tops([variants[0].results, variant.results]):
            raise ResultsError(
                f"{variants[0].folder} and {variant.folder} have no common point of the sweep: run"
                " one of them again with -flutter_friction (and _speed, _pressure, _damping) of the"
                " other one"
            )
    if not common_tops([variant.results for variant in variants]):
        raise ResultsError(
            f"no point of the sweep is common to all of {', '.join(map(str, folders))}"
        )
    return variants


def notes_of(variants):
    """Returns sentences on all that is compared with a restriction, or not at all."""
    first, tops = variants[0], common_tops([variant.results for variant in variants])
    every = list(dict.fromkeys(point for variant in variants for point in _listed(variant)))
    common = words_of_points(tops, every)
    notes = [f"{len(tops)} of {len(every)} points of the sweeps are common: {common}."]
    for variant in variants:
        extra = [point for point in variant.tops if point not in tops]
        if extra:
            notes.append(
                f"Not all variants have these points of {variant.name}, which are not compared:"
                f" {words_of_points(extra, every)}."
            )
        failed = [point for point in _listed(variant) if point not in variant.tops]
        if failed:
            notes.append(f"{variant.name} has no eigenvalues at {words_of_points(failed, every)}.")
    notes += _bands(variants, tops)
    for variant in variants[1:]:
        shared = shared_rows(first.results, variant.results, [first.name, variant.name])
        both = f"Modes of {first.name} and {variant.name}"
        named = all("name" in one.results.eigenvalues for one in (first, variant))
        rest = "name and frequency" if named else "frequency"
        notes.append(
            f"{both} are matched by {rest}: {shared}."
            if isinstance(shared, str)
            else f"{both} with stored shapes are matched by the MAC {shared.words}, other modes by"
            f" {rest}."
        )
    for name, words in (("case", "cases"), ("version", "versions of the program")):
        values = [str(variant.results.summary.get(name, "unknown")) for variant in variants]
        if len(set(values)) > 1:
            pairs = zip(variants, values)
            found = ", ".join(f"{variant.name}: {value}" for variant, value in pairs)
            notes.append(f"The {words} differ ({found}).")
    return notes


def _listed(variant):
    return [key_of(values) for values in variant.results.points.to_numpy()]


def words_of_points(points, every):
    """Returns points in words: their frictions, and the parameters that vary among all points."""
    shown = [place for place in range(1, len(PARAMETERS)) if len({p[place] for p in every}) > 1]
    lines = {}
    for point in points:
        line = words_of({PARAMETERS[place]: point[place] for place in shown})
        lines.setdefault(line, []).append(f"{point[0]:g}")
    return "; ".join(
        f"friction {', '.join(frictions)}" + (f" at {line}" if line else "")
        for line, frictions in lines.items()
    )


def _bands(variants, tops):
    """A sentence on the eigenvalues outside the common band, if the bands differ."""
    differ = [top for point, top in tops.items() if len({v.tops[point] for v in variants}) > 1]
    if not differ:
        return []
    above = ", ".join(
        f"{variant.name} {len(table)} ({int(table['counts'].sum())} unstable)"
        for variant, table in ((variant, variant.above(tops)) for variant in variants)
    )
    span = " to ".join(dict.fromkeys(f"{top:.6g} Hz" for top in (min(differ), max(differ))))
    return [
        f"The bands differ at {len(differ)} of {len(tops)} points; the common band ends there at"
        f" {span}. Eigenvalues above it are not compared: {above}."
    ]


def options_table(variants):
    """Returns the options that differ: a row for each, a column for each variant."""
    first, rest = variants[0], variants[1:]
    known = sorted(set().union(*(variant.options for variant in variants)))
    names = [name for name in known if any(differs(name, first, other) for other in rest)]
    return pd.DataFrame(
        {variant.name: [variant.options.get(name, "") for name in names] for variant in variants},
        index=pd.Index([f"-{name}" for name in names], name="option"),
    )


def results_table(variants):
    """Returns the results at the common points and in the common band: a row for each quantity, a
    column for each variant."""
    tops = common_tops([variant.results for variant in variants])
    return pd.DataFrame({variant.name: _outcome(variant, tops) for variant in variants})


def _outcome(variant, tops):
    table = variant.within(tops)
    grows = table[table["grows"]]
    worst = grows.loc[grows["growth_rate_1_per_s"].idxmax()] if len(grows) else None
    per_point = grows.groupby("point", sort=False).size()
    critical = critical_friction(variant, tops)
    summary = variant.results.summary
    return {
        "critical friction": critical["value"],
        "estimated error of the critical friction": critical["error"],
        "largest number of unstable modes at one point": int(per_point.max()) if len(grows) else 0,
        "unstable modes at all points": len(grows),
        "largest growth rate [1/s]": np.nan if worst is None else worst["growth_rate_1_per_s"],
        "its frequency [Hz]": np.nan if worst is None else worst["s"].imag / (2 * np.pi),
        "its friction": np.nan if worst is None else worst["friction"],
        **{f"{word} eigenvalues": int((table["verdict"] == word).sum()) for word in DOUBTS},
        "eigenvalues": len(table),
        "nodes of the mesh": summary.get("nodes", np.nan),
        "degrees of freedom": summary.get("dofs", np.nan),
    }


def critical_friction(variant, tops):
    """Returns the smallest friction at which stability is lost, or may be, as value, error and
    words; infinite for a variant that is stable at all common points."""
    table, critical = variant.within(tops), variant.results.critical
    found = []
    for line in dict.fromkeys(point[1:] for point in tops):
        frictions = sorted(point[0] for point in tops if point[1:] == line)
        top = min(tops[friction, *line] for friction in frictions)
        here = [] if critical is None else _losses(critical, line, frictions[-1], top)
        counted = {point for point in table["point"][table["counts"]]}
        grows = [friction for friction in frictions if (friction, *line) in counted]
        if grows and not any(value - error <= grows[0] for value, error in here):
            below = [friction for friction in frictions if friction < grows[0]]
            low = below[-1] if below else 0.0
            here.append(((low + grows[0]) / 2, (grows[0] - low) / 2))
        found += here
    if not found:
        last = max(point[0] for point in tops)
        return {"value": np.inf, "error": 0.0, "words": f"stable up to friction {last:g}"}
    value, error = min(found)
    known = error <= KNOWN * value
    words = f"{value:.7g}" if known else f"between {value - error:.6g} and {value + error:.6g}"
    return {"value": value, "error": error, "words": words}


def _losses(critical, line, last, top):
    """Frictions at which stability is lost on a line of the sweep, with their errors."""
    here = (critical["direction"] == "loss") & (critical["friction"] <= last)
    here &= critical["frequency_hz"] <= top
    here &= [key_of(values) == line for values in critical[list(PARAMETERS[1:])].to_numpy()]
    rows = critical[here]
    errors = rows.get("friction_error_estimate", pd.Series(0.0, rows.index)).fillna(0.0)
    return [(float(value), float(error)) for value, error in zip(rows["friction"], errors)]


def rankings(variants):
    """Returns the variants by each criterion, the quietest first: criterion, rank, variant, value,
    error, words, remark.

    Values that differ by less than their estimated errors are a tie. An undecided mode counts as
    unstable, and so does an uncertified one that grows: doubt moves no variant up.
    """
    tops = common_tops([variant.results for variant in variants])
    scores = {criterion: [] for criterion in CRITERIA}
    for variant in variants:
        table = variant.within(tops)
        counted = table[table["counts"]]
        per_point = counted.groupby("point", sort=False).size()
        most = int(per_point.max()) if len(counted) else 0
        scores["largest growth rate"].append(_largest_growth(counted))
        scores["number of unstable modes"].append(
            {
                "value": most,
                "error": 0.0,
                "words": f"{most} at one point, {len(counted)} at all points",
            }
        )
        scores["critical friction"].append(critical_friction(variant, tops))
    rows = []
    for criterion, found in scores.items():
        ranks = ranks_of([(one["value"], one["error"]) for one in found], CRITERIA[criterion])
        rows += [
            {"criterion": criterion, "rank": rank, "variant": variant.name, **score}
            for rank, variant, score in sorted(
                zip(ranks, variants, found), key=lambda row: (row[0], variants.index(row[1]))
            )
        ]
    remarks = {variant.name: _remark(variant, tops) for variant in variants}
    return pd.DataFrame(rows).assign(remark=lambda table: table["variant"].map(remarks))


def _largest_growth(counted):
    if not len(counted):
        return {"value": 0.0, "error": 0.0, "words": "no unstable mode"}
    worst = counted.loc[counted["growth_rate_1_per_s"].idxmax()]
    value, frequency = max(worst["growth_rate_1_per_s"], 0.0), worst["s"].imag / (2 * np.pi)
    error = max(np.nan_to_num(worst.get("error_estimate", 0.0)), SAME_NUMBER) * abs(worst["s"])
    return {
        "value": value,
        "error": error,
        "words": f"{value:.6g} 1/s at {frequency:.6g} Hz, friction {worst['friction']:g}",
    }


def ranks_of(scores, larger_is_quieter):
    """Returns the rank of each pair (value, error): 1 for the quietest, the same for ties."""
    order = sorted(
        range(len(scores)), key=lambda place: scores[place][0], reverse=larger_is_quieter
    )
    ranks, best = [0] * len(scores), None
    for position, place in enumerate(order, 1):
        value, error = scores[place]
        tie = best is not None and (
            value == scores[best][0] or abs(value - scores[best][0]) <= error + scores[best][1]
        )
        best = best if tie else place
        ranks[place] = ranks[best] if tie else position
    return ranks


def _remark(variant, tops):
    """What the ranks of a variant leave open, in words; empty if they leave nothing open."""
    table, above = variant.within(tops), int(variant.above(tops)["counts"].sum())
    words = [
        f"{count} of {len(table)} eigenvalues are {word}"
        for word in DOUBTS
        if (count := int((table["verdict"] == word).sum()))
    ]
    if above:
        words.append(f"unstable modes above the common band, not ranked: {above}")
    return "; ".join(words)


__all__ = [
    "CRITERIA",
    "Variant",
    "critical_friction",
    "notes_of",
    "options_table",
    "rankings",
    "ranks_of",
    "read_variants",
    "results_table",
    "words_of_points",
]
