# SPDX-License-Identifier: BSD-2-Clause
"""The exploded view of the report: how far each body is moved away from the others."""
import numpy as np

STEP = 0.22  # between neighbours, relative to the size of the model


def rotation_of(options, bodies):
    """Returns the axis of rotation (direction, point, names of the bodies that rotate about it);
    None without a rotating body."""
    rotors = [
        body["name"]
        for body in bodies
        if _number(options, body["name"], "speed") or _number(options, body["name"], "rpm")
    ]
    if not rotors:
        return None
    axis = _vector(options.get(f"motion_{rotors[0]}_axis", "0,0,1"))
    origin = _vector(options.get(f"motion_{rotors[0]}_origin", "0,0,0"))
    return axis / np.linalg.norm(axis), origin, rotors


def _number(options, body, key):
    return float(options.get(f"motion_{body}_{key}", 0))


def _vector(text):
    values = [float(word) for word in text.split(",")]
    return np.array(values + [0.0] * (3 - len(values)))


def offsets(places, bodies, rotation, linings):
    """Returns the offset of each body in the exploded view.

    Next to a rotating disc, the bodies of each side move along the axis, one step farther for each.
    Bodies that reach over both sides, such as a caliper, move away from the axis. Without rotation,
    all bodies move away from the middle of the model.
    """
    parts = [places[slice(*body["nodes"])] for body in bodies]
    low, high = places.min(axis=0), places.max(axis=0)
    centres = np.array([(part.min(axis=0) + part.max(axis=0)) / 2 for part in parts])
    if rotation is None:
        return 1.2 * (centres - (low + high) / 2)
    axis, origin, rotors = rotation
    still = [k for k, body in enumerate(bodies) if body["name"] not in rotors]
    heights = [(part - origin) @ axis for part in parts]
    middle, half = _ring(heights, bodies, rotors, linings)
    over = [
        k
        for k in still
        if heights[k].min() < middle - half - 1e-9 and heights[k].max() > middle + half + 1e-9
    ]
    step, result = STEP * (high - low).max(), np.zeros((len(bodies), 3))
    level = (centres - origin) @ axis - middle
    for sign in (-1, 1):
        side = [k for k in still if k not in over and (level[k] >= 0) == (sign > 0)]
        for rank, k in enumerate(sorted(side, key=lambda k: abs(level[k])), 1):
            result[k] = sign * rank * step * axis
    outwards = centres - origin - ((centres - origin) @ axis)[:, None] * axis
    for rank, k in enumerate(sorted(over, key=lambda k: np.linalg.norm(outwards[k])), 1):
        away = np.linalg.norm(outwards[k])
        if away > 1e-6 * step:
            result[k] = (0.5 + rank) * step * outwards[k] / away
    return result - _shift(parts, result, (low + high) / 2)


def _shift(parts, result, middle):
    """Returns how far the middle of the exploded bodies is from that of the model."""
    moved = [(part.min(axis=0) + by, part.max(axis=0) + by) for part, by in zip(parts, result)]
    low, high = (np.array([pair[end] for pair in moved]) for end in (0, 1))
    return (low.min(axis=0) + high.max(axis=0)) / 2 - middle


def _ring(heights, bodies, rotors, linings):
    """Returns the height of the middle of the ring between the linings, and half its thickness. If
    the disc has linings on one side only, or none, the disc itself gives both values."""
    planes = [lining["height"] for lining in linings if lining["sliding"]]
    if planes and max(planes) > min(planes):
        return (max(planes) + min(planes)) / 2, (max(planes) - min(planes)) / 2
    ring = np.concatenate([heights[k] for k, b in enumerate(bodies) if b["name"] in rotors])
    return (ring.max() + ring.min()) / 2, (ring.max() - ring.min()) / 2


__all__ = ["offsets", "rotation_of"]
