# SPDX-License-Identifier: BSD-2-Clause
"""Cards and comparisons that tests of Nastran decks share."""
import numpy as np
import small_decks

COMPLEX = "SOL 110\nCEND\nSPC = 10\nMETHOD = 5\nBEGIN BULK\n"
EIGRL = "EIGRL,5,,,3\n"


def numbers(text):
    return np.array(small_decks.numbers(text))


def turned(axis, degrees):
    """Returns a rotation about an axis as a matrix."""
    k, angle = np.array(axis, float) / np.linalg.norm(axis), np.radians(degrees)
    cross = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


TURN = turned((1, 2, -0.5), 40)
ORIGIN = np.array([0.3, -0.2, 0.7])


def card(name, number, reference, origin, axes):
    """Returns a system whose axes are the rows of `axes`, by three points of `reference`."""
    points = np.concatenate([origin, origin + 2 * axes[2], origin + axes[2] + 3 * axes[0]])
    words = [f"{value!r}" for value in points.tolist()]
    first = ",".join([name, str(number), str(reference), *words[:6]])
    return f"{first}\n,{','.join(words[6:])}\n"


def frame_of(options, name):
    """Returns the rectangular axes of a frame as rows."""
    x, other = (numbers(options["frame"][name][key]) for key in ("x", "xy"))
    x = x / np.linalg.norm(x)
    z = np.cross(x, other) / np.linalg.norm(np.cross(x, other))
    return np.array([x, np.cross(z, x), z])
