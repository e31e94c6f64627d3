# SPDX-License-Identifier: BSD-2-Clause
"""Which points are near which triangles, by a grid of boxes over the points."""
import numpy as np

MOST = 2_000_000  # pairs at a time


def _ranges(starts, counts):
    """Returns the numbers start, start + 1, … of each range, and to which range each belongs."""
    owner = np.repeat(np.arange(len(counts)), counts)
    offsets = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    return starts[owner] + offsets, owner


def _groups(sizes):
    """Yields slices of consecutive items whose sizes add up to about MOST at most."""
    ends = np.cumsum(sizes)
    begin = 0
    while begin < len(sizes):
        before = ends[begin - 1] if begin else 0
        end = max(begin + 1, int(np.searchsorted(ends, before + MOST, side="right")))
        yield slice(begin, end)
        begin = end


def pairs_nearby(points, triangles, margin):
    """Yields arrays (points, triangles) of numbers of pairs, in the order of the triangles: those
    whose point lies in the bounding box of the triangle, widened by a margin."""
    if not len(points) or not len(triangles):
        return
    low, high = triangles.min(axis=1) - margin, triangles.max(axis=1) + margin
    origin = points.min(axis=0)
    # At most a million boxes along an axis, so that the numbers of boxes are exact, and not many
    # more boxes in all triangles than there are triangles and points.
    extent = float(np.max(points.max(axis=0) - origin))
    edge = max(float(np.mean(high - low, axis=0).max()), 1e-6 * extent) or 1.0
    while True:
        boxes = np.floor((points - origin) / edge).astype(np.int64)
        shape = boxes.max(axis=0) + 1
        first = np.clip(np.floor((low - origin) / edge), 0, shape).astype(np.int64)
        last = np.clip(np.floor((high - origin) / edge), -1, shape - 1).astype(np.int64)
        spans = np.maximum(last - first + 1, 0)
        counts = np.prod(spans, axis=1)
        if np.sum(counts) <= 30 * (len(points) + len(triangles)):
            break
        edge *= 2
    keys = (boxes[:, 0] * shape[1] + boxes[:, 1]) * shape[2] + boxes[:, 2]
    order = np.argsort(keys, kind="stable")
    keys = keys[order]
    for some in _groups(counts):
        number, owner = _ranges(np.zeros(len(counts[some]), np.int64), counts[some])
        owner += some.start
        across = spans[owner, 1] * spans[owner, 2]
        box = (first[owner, 0] + number // across) * shape[1]
        box = (box + first[owner, 1] + number % across // spans[owner, 2]) * shape[2]
        box += first[owner, 2] + number % spans[owner, 2]
        starts = np.searchsorted(keys, box)
        inside = np.searchsorted(keys, box, side="right") - starts
        for part in _groups(inside):
            place, which = _ranges(starts[part], inside[part])
            at, triangle = order[place], owner[part][which]
            within = np.all((points[at] >= low[triangle]) & (points[at] <= high[triangle]), axis=1)
            yield at[within], triangle[within]
