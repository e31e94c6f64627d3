# SPDX-License-Identifier: BSD-2-Clause
"""Reads summary.json, the overview of a run, and checks its form."""
import json

from squeal.files import ResultsError, read_text
from squeal.keys import PARAMETERS

NUMBER = (float, int)
# The form of summary.json, as far as this package reads it: a name with ? may be missing, * means
# all names.
SUMMARY = {
    "version": str,
    "complete": bool,
    "options?": {"*": str},
    "frictions?": [
        {
            **dict.fromkeys(PARAMETERS, NUMBER),
            "eigenvalues?": int,
            "verdict?": str,
            "verdicts?": {"*": int},
            "unstable_modes?": [dict],
            "band_top_hz?": (*NUMBER, type(None)),
            "steady?": {
                "converged?": bool,
                "open_nodes?": int,
                "interfaces?": {"*": {"normal_force_n?": [NUMBER], "friction_force_n?": [NUMBER]}},
            },
        }
    ],
    "active_sets?": [{"followed?": [{"critical_frictions?": [NUMBER], "statement?": str}]}],
    "stages?": {"*": {"wall_s?": NUMBER, "peak_memory_bytes?": NUMBER}},
    "wall_s?": NUMBER,
    "verdict?": {"sentence": str},
    "parts?": [{"folder": str}],
    "tables?": {"*": {"rows": int, "columns": [str]}},
    "regimes?": [{**dict.fromkeys(PARAMETERS, NUMBER), "start": str, "class": str}],
}
KINDS = {
    bool: "not true or false",
    str: "not a text",
    float: "not a number",
    int: "not a whole number",
    dict: "not an object",
    list: "not a list",
}


def read_summary(path):
    """Returns the content of summary.json, of a run or of a merge."""
    try:
        summary = json.loads(read_text(path))
    except ResultsError:
        raise
    except (FileNotFoundError, NotADirectoryError):
        raise ResultsError(
            f"{path.parent} holds no complete results: there is no summary.json"
        ) from None
    except (ValueError, RecursionError) as error:
        raise ResultsError(f"{path}: {error}") from None
    for wrong in _departures(summary, SUMMARY, ""):
        raise ResultsError(f"{path} is not a summary of a run: {wrong}")
    try:
        float(summary.get("options", {}).get("flutter_unstable_tolerance", "0"))
    except ValueError:
        raise ResultsError(
            f"{path} is not a summary of a run:"
            " `options.flutter_unstable_tolerance` is not a number"
        ) from None
    return summary


def _departures(found, form, place):
    """Yields in words each difference between a value and a form."""
    kinds = form if isinstance(form, tuple) else (form if isinstance(form, type) else type(form),)
    if not isinstance(found, kinds) or (isinstance(found, bool) and bool not in kinds):
        yield f"{f'`{place}`' if place else 'it'} is {KINDS[kinds[0]]}"
    elif isinstance(form, list):
        for number, entry in enumerate(found):
            yield from _departures(entry, form[0], f"{place}[{number}]")
    elif isinstance(form, dict):
        for name, inner in form.items():
            for key in found if name == "*" else [name.rstrip("?")]:
                below = f"{place}.{key}" if place else key
                if key in found:
                    yield from _departures(found[key], inner, below)
                elif not name.endswith("?"):
                    yield f"`{below}` is missing"


__all__ = ["read_summary"]
