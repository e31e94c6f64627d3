# SPDX-License-Identifier: BSD-2-Clause
"""The verdict of a run or of a merge, and its grounds, in sentences."""
from squeal.keys import PARAMETERS


def verdict(results):
    """Returns one sentence on the stability of the sweep: that of the program, or for a merge one
    from its tables."""
    given = results.summary.get("verdict")
    return given["sentence"] if given else _verdict_of_merge(results)


def _verdict_of_merge(results):
    table, points, critical = results.eigenvalues, results.stability_map, results.critical
    grows = table[table["grows"]]
    if len(points) == 0:
        return "No point of the sweep has a steady sliding state."
    where = (
        "at all points of the sweep"
        if len(points) > 1
        else f"at friction {points['friction'].iloc[0]:g}"
    )
    solved = points[points["unstable_modes"].notna()]
    listed = set(table[list(PARAMETERS)].itertuples(index=False, name=None))
    unknown = sum(
        point not in listed for point in solved[list(PARAMETERS)].itertuples(index=False, name=None)
    )
    rest = _open(table, unknown)
    if results.summary.get("complete") is False:
        found = "all of them are stable"
        if not grows.empty:
            found = (
                "the lowest friction among them with an unstable mode is"
                f" {grows['friction'].min():g}"
            )
        elif unknown:
            found = "none of them has an unstable mode"
        return (
            f"The run was stopped before its end: {len(solved)} of {len(points)} points are solved,"
            f" and {found}{rest}."
        )
    if grows.empty:
        if unknown:
            where = (
                f"at the {len(solved) - unknown} of {len(points)} points of the sweep with a known"
                " stability"
            )
        return (
            f"Stable {where}{rest}."
            if len(table)
            else f"No eigenvalue was found in the band {where}."
        )
    worst = grows.loc[grows["growth_rate_1_per_s"].idxmax()]
    begins = None
    if critical is not None and len(critical) and len(results.swept()) <= 1:
        lost = critical[(critical["direction"] == "loss") & (critical["converged"] == 1)][
            "friction"
        ]
        below = points[points["unstable_modes"] > 0]["friction"].min()
        if len(lost) and lost.min() <= below:
            begins = (
                f"Stable up to friction {lost.min():.6g}"
                if lost.min() > 0
                else "Unstable as soon as there is friction"
            )
    if begins is None:
        first = points[points["unstable_modes"] > 0]["friction"].min()
        begins = (
            f"Unstable from friction {first:g} on"
            if first > points["friction"].min()
            else f"Unstable at friction {first:g} already"
        )
    most = int(points["unstable_modes"].max())
    others = "".join(
        f", {name} {worst[name]:g}" for name in PARAMETERS[1:] if name in results.swept()
    )
    return (
        f"{begins}; above it, up to {most} unstable mode{'s' if most > 1 else ''} at once. The"
        f" fastest-growing one, at {worst['frequency_hz']:.6g} Hz, has a growth rate of"
        f" {worst['growth_rate_1_per_s']:.4g} 1/s (damping {100 * worst['damping_ratio']:.3g} %) at"
        f" friction {worst['friction']:g}{others}{rest}."
    )


def _open(table, unknown):
    """Returns what a sentence must not hide: points and eigenvalues without a verdict."""
    counts = (
        (
            int((table["verdict"] == "undecided").sum()),
            "eigenvalue is undecided",
            "eigenvalues are undecided",
        ),
        (
            int((table["verdict"] == "uncertified").sum()),
            "eigenvalue is uncertified",
            "eigenvalues are uncertified",
        ),
        (
            unknown,
            "point has no eigenvalue in the band, so its stability is unknown",
            "points have no eigenvalue in the band, so their stability is unknown",
        ),
    )
    return "".join(
        f"; {count} {one if count == 1 else several}" for count, one, several in counts if count
    )


def certificate(results):
    """Returns the grounds of the verdict, in sentences."""
    table, summary = results.eigenvalues, results.summary
    certified = int((table["certified"] == 1).sum()) if "certified" in table else 0
    if "referee" in summary:
        return _judgement(summary["referee"], len(table))
    lines = [
        f"{certified} of {len(table)} eigenvalues are certified against the full-order problem"
    ]
    if "error_estimate" in table and len(table):
        lines[0] += (
            f": backward errors up to {table['backward_error'].max():.1e}, estimated errors"
            f" |δs|/|s| up to {table['error_estimate'].max():.1e}"
        )
    lines[0] += "."
    lines += [
        followed["statement"][0].upper() + followed["statement"][1:] + "."
        for active in summary.get("active_sets", [])
        for followed in active.get("followed", [])
        if followed.get("statement")
    ][:3]
    lines += _proof(results.table("proof"))
    failed = [
        point
        for point in summary.get("frictions", [])
        if not (point.get("steady") or {"converged": True}).get("converged", True)
    ]
    if failed:
        lines.append(
            f"{len(failed)} points of the sweep have no steady sliding state: "
            + ", ".join(f"{p['friction']:g}" for p in failed[:8])
            + "."
        )
    return lines


def _proof(table):
    """Returns a sentence on the proofs of the lists, if there are any."""
    if table is None or table.empty:
        return []
    complete = table[table["complete"] == 1]
    words = f"The list is proved to be complete at {len(complete)} of {len(table)} points"
    if len(complete):
        words += f" (largest ratio {complete['ratio'].max():.2g}; round-off is not bounded)"
    return [words + "."]


def _judgement(referee, count):
    """Returns the judgement of the list of another program, in sentences."""
    most = 20
    faults = referee["faults"]
    lines = [
        "The list is complete and right." if referee["complete"] else "The list has faults.",
        referee["sentence"][0].upper() + referee["sentence"][1:] + ".",
        f"The eigenvalues of this report are {count} proved ones, each in a disc of its own.",
    ]
    lines += [fault[0].upper() + fault[1:] + "." for fault in faults[:most]]
    if len(faults) > most:
        lines.append(f"{len(faults) - most} more entries are not right: referee.csv.")
    return lines


__all__ = ["certificate", "verdict"]
