# SPDX-License-Identifier: BSD-2-Clause
"""Pairs the eigenvalues of one run with those of another."""
import numpy as np
from scipy.optimize import linear_sum_assignment

from squeal.results import NOISE


def unstable(s, tolerance=NOISE):
    return s.real > tolerance * np.abs(s)


def match(wanted, found, farthest=0.02, apart=None):
    """Returns for each wanted eigenvalue the index of its partner among the found ones, or -1.

    The assignment minimises the sum of relative distances, and pairs no eigenvalues further
    apart than `farthest`. It uses none twice, so that a double eigenvalue found once is noticed.
    The order in sorted lists does not help where two eigenvalues meet. `apart` marks pairs that are
    known to be different, [wanted, found].
    """
    wanted, found = np.asarray(wanted), np.asarray(found)
    partner = np.full(len(wanted), -1)
    if len(wanted) == 0 or len(found) == 0:
        return partner
    sizes = np.maximum(np.abs(wanted), np.finfo(float).tiny)
    distance = np.abs(wanted[:, None] - found[None, :]) / sizes[:, None]
    if apart is not None:
        distance[apart] = farthest
    # Beyond `farthest` all distances count the same: an eigenvalue without partner takes none from
    # the others.
    rows, columns = linear_sum_assignment(np.minimum(distance, farthest))
    close = distance[rows, columns] < farthest
    partner[rows[close]] = columns[close]
    return partner


def compare(exact, found, top, tolerance=NOISE):
    """Compares `found` with `exact` up to |s| = top. Both lists should reach a little further,
    so that eigenvalues at the edge find their partners."""
    exact, found = np.asarray(exact), np.asarray(found)
    low, mine = exact[np.abs(exact) <= top], found[np.abs(found) <= top]
    forward, backward = match(low, found), match(mine, exact)
    paired, s, partner = forward >= 0, low[forward >= 0], found[forward[forward >= 0]]
    stays_unstable = np.zeros(len(low), bool)
    stays_unstable[paired] = unstable(partner, tolerance)
    is_unstable = np.zeros(len(mine), bool)
    is_unstable[backward >= 0] = unstable(exact[backward[backward >= 0]], tolerance)
    return {
        "exact": len(low),
        "found": len(mine),
        "without_partner": int(np.sum(~paired) + np.sum(backward < 0)),
        "exact_unstable": int(np.sum(unstable(low, tolerance))),
        "found_unstable": int(np.sum(unstable(mine, tolerance))),
        "missed": int(np.sum(unstable(low, tolerance) & ~stays_unstable)),
        "invented": int(np.sum(unstable(mine, tolerance) & ~is_unstable)),
        "relative_error": float(np.max(np.abs(partner - s) / np.abs(s), initial=0)),
        "growth_error": float(np.max(np.abs(partner.real - s.real), initial=0)),
    }
