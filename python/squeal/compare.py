# SPDX-License-Identifier: BSD-2-Clause
"""Compares the results of variants of a brake in one HTML file that opens offline."""
import argparse
import html
import os
from pathlib import Path

import numpy as np
import pandas as pd

from squeal.files import ResultsError, is_there, read_text
from squeal.folder import Folder
from squeal.keys import PARAMETERS, key_of
from squeal.page import WEB, columns, data_text, fill, plain, script_element
from squeal.pairs import common_tops, compare
from squeal.parts import SAME_NUMBER
from squeal.variants import (
    CRITERIA,
    notes_of,
    options_table,
    rankings,
    read_variants,
    results_table,
    words_of_points,
)
from squeal.verdict import verdict

OWN_SCRIPTS = ("basics", "figure", "compare")
MARK = '<meta name="generator" content="squeal-compare">'
EIGENVALUES = (
    *PARAMETERS,
    "mode",
    "frequency_hz",
    "growth_rate_1_per_s",
    "damping_ratio",
    "verdict",
    "grows",
    "name",
)
CELLS = ("mode", "frequency_hz", "growth_rate_1_per_s", "verdict", "name")
CHANGES = ("frequency_change_hz", "growth_change_1_per_s", "mac", "matched_by")


def build(variants):
    """Returns the text of the HTML file for variants of squeal.variants."""
    data = page_data(variants)
    parts = {
        "title": html.escape(data["title"]),
        "mark": MARK,
        "style": (WEB / "report.css").read_text() + (WEB / "compare.css").read_text(),
        "verdict": html.escape(data["verdict"]),
        "notes": "".join(f"<li>{html.escape(line)}</li>" for line in data["notes"]),
        "data": data_text(data),
        "scripts": "\n".join(
            script_element((WEB / f"{name}.js").read_text()) for name in OWN_SCRIPTS
        ),
    }
    return fill("compare.html", parts)


def page_data(variants):
    """Returns all that the page shows."""
    tops = common_tops([variant.results for variant in variants])
    ranks = rankings(variants)
    cases = dict.fromkeys(variant.results.summary.get("case", variant.name) for variant in variants)
    swept = [
        name
        for place, name in enumerate(PARAMETERS)
        if len({point[place] for variant in variants for point in variant.tops}) > 1
    ]
    return {
        "title": f"{len(variants)} variants of {', '.join(cases)}: brake squeal",
        "verdict": sentence_of(ranks),
        "notes": notes_of(variants),
        "parameters": list(PARAMETERS),
        "swept": swept,
        "common": [list(point) for point in tops],
        "variants": [
            {
                "name": variant.name,
                "sentence": verdict(variant.results),
                "eigenvalues": columns(_taken(variant.results.eigenvalues, EIGENVALUES)),
                "branches": columns(variant.results.branches),
                "critical": columns(variant.results.critical),
            }
            for variant in variants
        ],
        "options": _options(variants),
        "results": _results(variants),
        "rankings": [
            {
                "criterion": criterion,
                "rows": ranks[ranks["criterion"] == criterion][
                    ["rank", "variant", "words", "remark"]
                ].values.tolist(),
            }
            for criterion in CRITERIA
        ],
        "modes": matched_modes(variants, tops),
    }


def sentence_of(ranks):
    """Returns the quietest variants by each criterion in one sentence."""
    found = []
    for criterion in CRITERIA:
        rows = ranks[ranks["criterion"] == criterion]
        best = list(rows[rows["rank"] == 1]["variant"])
        tie = "a tie of all" if len(best) == len(rows) else " and ".join(best)
        found.append(f"by {criterion}: {tie}")
    return f"Quietest {'; '.join(found)}."


def _taken(table, names):
    return table[[name for name in names if name in table]]


def _options(variants):
    """Rows of [option, values, changes]; a change is relative to the first variant, in percent."""
    rows = []
    for name, values in options_table(variants).iterrows():
        numbers = [_number(value) for value in values]
        changes = [
            None
            if None in (number, numbers[0]) or not numbers[0]
            else 100 * (number / numbers[0] - 1)
            for number in numbers
        ]
        rows.append([name, list(values), [None, *map(plain, changes[1:])]])
    return rows


def _number(text):
    try:
        return float(text)
    except ValueError:
        return None


def _results(variants):
    """Rows of [quantity, values, differences from the first variant]."""
    rows = []
    for name, values in results_table(variants).iterrows():
        first, *rest = map(plain, values)
        known = first is not None and not name.startswith("estimated error")
        changes = [
            _change(value - first, value) if known and value is not None else None for value in rest
        ]
        rows.append([name, [first, *rest], [None, *changes]])
    return rows


def _change(change, size):
    """Returns a change, or 0 if it is below the round-off of a value of that size."""
    return 0.0 if abs(change) <= SAME_NUMBER * abs(size) else change


def matched_modes(variants, tops):
    """Returns the modes of the first variant in pairs with those of the others: a group of the free
    modes, and one for each common point. A group has a name and rows with one cell per variant;
    the cell of a variant without the mode is None."""
    tables = [compare(variants[0].results, other.results, tops) for other in variants[1:]]
    groups = [("free", None), *(("complex", point) for point in tops)]
    found = []
    for kind, point in groups:
        own, lonely = {}, []
        for place, table in enumerate(tables):
            for row in _of_group(table, kind, point).to_dict("records"):
                cell = _cell(row, "other_", (*CELLS, *CHANGES))
                if pd.isna(row["mode"]):
                    others = [None] * len(tables)
                    others[place] = cell
                    lonely.append([None, *others])
                    continue
                first = own.setdefault(
                    int(row["mode"]), [_cell(row, "", CELLS), *[None] * len(tables)]
                )
                first[1 + place] = cell
        if own or lonely:
            name = "free modes" if point is None else words_of_points([point], list(tops))
            rows = [own[number] for number in sorted(own)] + lonely
            found.append({"name": name, "kind": kind, "rows": rows})
    return found


def _of_group(table, kind, point):
    here = table["kind"] == kind
    if point is not None:
        here &= [key_of(values) == point for values in table[list(PARAMETERS)].to_numpy()]
    return table[here]


def _cell(row, prefix, names):
    """The values of one variant in a row of a table of pairs; None without a mode."""
    if pd.isna(row[prefix + "mode"]):
        return None
    cell = {name: row[prefix + name if name in CELLS else name] for name in names}
    cell["mode"] = int(cell["mode"])
    size = np.hypot(2 * np.pi * cell["frequency_hz"], np.nan_to_num(cell["growth_rate_1_per_s"]))
    for name, unit in (("frequency_change_hz", 2 * np.pi), ("growth_change_1_per_s", 1)):
        if name in cell:
            cell[name] = _change(cell[name], size / unit)
    return {name: plain(value) for name, value in cell.items()}


def write(path, text):
    """Writes the page. Replaces an earlier one, and nothing else."""
    path = Path(path)
    try:
        earlier = is_there(path) and MARK in read_text(path)
    except ResultsError as error:
        raise ResultsError(f"{error}: name another file with -o") from None
    if os.path.lexists(path) and not earlier:
        raise ResultsError(
            f"{path} exists and is not a page of squeal-compare: name another file with -o, or move"
            " it"
        )
    return Folder(path.parent).save_text(path.name, text)


HELP = """squeal-compare DIR DIR...: draws the results of variants of a brake in the same diagrams.

Each folder DIR holds the complete results of one variant; the first one is the reference for all
differences. The page FILE opens in any browser without a network: damping ratio over frequency,
frequency and growth over the friction, modes matched between the variants, options and results that
differ, and which variant is the quietest. The command prints what it does not compare, and replaces
only an earlier page in FILE.
"""


def main(words):
    parser = argparse.ArgumentParser(
        prog="squeal-compare",
        description=HELP,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("folders", metavar="DIR", nargs="+")
    parser.add_argument(
        "-o", "--output", metavar="FILE.html", default="compare.html", help="default: compare.html"
    )
    arguments = parser.parse_args(words)
    variants = read_variants(arguments.folders)
    path = write(arguments.output, build(variants))
    for line in notes_of(variants):
        print(f"compare: {line}")
    print(path)


__all__ = ["build", "main", "matched_modes", "page_data", "sentence_of", "write"]
