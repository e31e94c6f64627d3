# SPDX-License-Identifier: BSD-2-Clause
"""Pairs the modes of one run with those of another one: Results.mac and Results.compare."""
import numpy as np
import pandas as pd
from scipy.optimize import linear_sum_assignment

from squeal.files import ResultsError
from squeal.keys import PARAMETERS, key_of, words_of
from squeal.mac import mac, shared_rows
from squeal.matching import match

LEAST_MAC = 0.5  # of a pair of modes
FARTHEST = 0.05  # relative distance |s' - s|/|s| of a pair without shapes and names
FARTHEST_NAMED = 0.2  # of a pair with one name
KINDS = ("complex", "free")
SIDE = ("mode", "frequency_hz", "growth_rate_1_per_s", "verdict", "name")


def mac_table(one, other, kind, at):
    """Returns the MAC of the stored modes of two runs, by their numbers."""
    if kind not in KINDS:
        raise ResultsError(f"{kind} is not a kind of modes: {', '.join(KINDS)}")
    shared = shared_rows(one, other)
    if isinstance(shared, str):
        raise ResultsError(f"a MAC needs shapes on one mesh, but {shared}")
    shapes = [_shapes(run, kind, _point(run, kind, at)) for run in (one, other)]
    for run, found in zip((one, other), shapes):
        if not found:
            where = f" at {words_of(at)}" if at else ""
            raise ResultsError(f"{run.folder} holds no shape of a {kind} mode{where}")
    return pd.DataFrame(
        _macs(shared, *shapes),
        index=pd.Index(list(shapes[0]), name="mode"),
        columns=pd.Index(list(shapes[1]), name="other mode"),
    )


def compare(one, other, tops=None):
    """Returns the modes of two runs in pairs: free modes, then complex modes at the common points.

    `tops` limits the compared band: an upper frequency |s|/2π by point, by default the lower one of
    the two runs. A pair is listed if one of its modes is in the band.
    """
    if tops is None:
        tops = common_tops([one, other])
    shared = shared_rows(one, other)
    tables = [_free_pairs(one, other, shared)]
    runs = [(run, _parameters(run)) for run in (one, other)]
    for point, top in tops.items():
        sides = [_side_of(run, own[point]) for run, own in runs]
        shapes = [_shapes(run, "complex", own[point]) for run, own in runs]
        tables.append(_pairs("complex", point, sides, _known(shared, sides, shapes), top))
    return pd.concat([table for table in tables if len(table)] or tables[:1], ignore_index=True)


def common_tops(runs):
    """Returns the tops of the common bands of runs in Hz by common point, in the order of the first
    run. A top is infinite if the runs list eigenvalues without one."""
    tops = [tops_of(run) for run in runs]
    return {
        point: min(each[point] for each in tops)
        for point in tops[0]
        if all(point in each for each in tops)
    }


def tops_of(run):
    """Returns the top of the band in Hz by point; points without eigenvalues are omitted."""
    solved = run.stability_map[run.stability_map["unstable_modes"].notna()]
    listed = {
        key_of(point[name] for name in PARAMETERS): point.get("band_top_hz")
        for point in run.summary.get("frictions", [])
    }
    points = [key_of(values) for values in solved[list(PARAMETERS)].to_numpy()]
    return {point: listed.get(point) or np.inf for point in points}


def _parameters(run):
    """Returns the parameters of each point by its key, which has fewer digits."""
    return {key_of(at.values()): at for at in run.points.to_dict("records")}


def _point(run, kind, at):
    """Returns the parameters of the only point of a run with some values; none for free modes."""
    return {} if kind == "free" else dict(run.only_point(at))


def _shapes(run, kind, at):
    """Returns the stored shapes of a point, or of the free modes, by number."""
    if not run.has_shapes():
        return {}
    if kind == "free":
        return run.free_shapes()
    return run.shapes(**at)


def _macs(shared, one, other):
    return mac(
        [shape[shared.one] for shape in one.values()],
        [shape[shared.other] for shape in other.values()],
        shared.weights,
    )


def _known(shared, sides, shapes):
    """Returns the MAC of each mode of one side with each of the other; nan without shapes."""
    known = np.full([len(side) for side in sides], np.nan)
    if not isinstance(shared, str) and all(shapes):
        places = [
            [list(side["mode"]).index(number) for number in found]
            for side, found in zip(sides, shapes)
        ]
        known[np.ix_(*places)] = _macs(shared, *shapes)
    return known


def _side_of(run, at):
    """Returns the eigenvalues of a point."""
    table = run.eigenvalues
    here = np.ones(len(table), bool)
    for name, value in at.items():
        here &= np.isclose(table[name], value, rtol=1e-12, atol=1e-300)
    return _named(
        table[here].assign(frequency_hz=lambda rows: rows["s"].to_numpy().imag / (2 * np.pi))
    )[[*SIDE, "s"]]


def _named(table):
    """Returns a table with the names of modes; empty where there is none."""
    return table.assign(name=table["name"].fillna("") if "name" in table else "")


def _free_pairs(one, other, shared):
    tables = [run.free_modes for run in (one, other)]
    if any(table is None or not len(table) for table in tables):
        return _pairs("free", None, [_no_side()] * 2, np.zeros((0, 0)), np.inf)
    sides = [
        _named(table).assign(
            growth_rate_1_per_s=np.nan,
            verdict="",
            s=1j * table["angular_frequency_rad_per_s"].to_numpy(),
        )
        for table in tables
    ]
    shapes = [_shapes(run, "free", {}) for run in (one, other)]
    top = min(side["frequency_hz"].max() for side in sides)
    return _pairs("free", None, sides, _known(shared, sides, shapes), top)


def _no_side():
    return pd.DataFrame({name: [] for name in (*SIDE, "s")})


def _pairs(kind, point, sides, macs, top):
    """Returns a table of pairs, in the order of the first side, then the rest of the other one."""
    partner, by = pair(
        *(side["s"].to_numpy() for side in sides), macs, [side["name"] for side in sides]
    )
    missing = np.setdiff1d(np.arange(len(sides[1])), partner)
    first = np.append(np.arange(len(sides[0])), np.full(len(missing), -1)).astype(int)
    second = np.append(partner, missing).astype(int)
    table = {"kind": np.full(len(first), kind)}
    for place, name in enumerate(PARAMETERS):
        table[name] = np.full(len(first), np.nan if point is None else point[place])
    inside = np.zeros(len(first), bool)
    for side, rows, prefix in zip(sides, (first, second), ("", "other_")):
        taken = side.reset_index(drop=True).reindex(np.where(rows < 0, len(side), rows))
        inside |= np.abs(taken["s"].to_numpy()) <= 2 * np.pi * top * (1 + 1e-12)
        for name in SIDE:
            table[prefix + name] = taken[name].to_numpy()
        table[prefix + "mode"] = pd.array(taken["mode"], dtype="Int64")
    for name, change in (
        ("frequency_hz", "frequency_change_hz"),
        ("growth_rate_1_per_s", "growth_change_1_per_s"),
    ):
        table[change] = table["other_" + name] - table[name]
    both = (first >= 0) & (second >= 0)
    table["mac"] = np.full(len(first), np.nan)
    table["mac"][both] = macs[first[both], second[both]]
    table["matched_by"] = np.append(by, np.full(len(missing), ""))
    return pd.DataFrame(table)[inside]


def pair(one, other, macs, names=None):
    """Returns for each eigenvalue the index of its partner among the others, or -1, and how it was
    found: "MAC", "name", "frequency" or "".

    Pairs with a known MAC come first, then modes of one name. Modes with a MAC below LEAST_MAC are
    not the same mode, however near their frequencies are.
    """
    one, other = np.asarray(one, complex), np.asarray(other, complex)
    alike = np.where(np.isfinite(macs) & (macs >= LEAST_MAC), macs, 0.0)
    rows, columns = linear_sum_assignment(-alike)
    found = alike[rows, columns] > 0
    partner, by = np.full(len(one), -1), np.full(len(one), "", dtype=object)
    partner[rows[found]], by[rows[found]] = columns[found], "MAC"
    apart = {"frequency": np.isfinite(macs)}
    if names is not None:
        mine, others = (np.asarray(list(each), object) for each in names)
        same = (mine[:, None] == others[None, :]) & (mine != "")[:, None]
        apart = {"name": np.isfinite(macs) | ~same, **apart}
    for word, different in apart.items():
        left = np.flatnonzero(partner < 0)
        rest = np.setdiff1d(np.arange(len(other)), partner)
        farthest = FARTHEST_NAMED if word == "name" else FARTHEST
        near = match(one[left], other[rest], farthest, different[np.ix_(left, rest)])
        partner[left[near >= 0]], by[left[near >= 0]] = rest[near[near >= 0]], word
    return partner, by


__all__ = ["FARTHEST", "LEAST_MAC", "common_tops", "compare", "mac_table", "pair", "tops_of"]
