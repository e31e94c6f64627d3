# SPDX-License-Identifier: BSD-2-Clause
"""A brake as a deck of CalculiX: a ring between two pads, of tetrahedra that match node on node.

CalculiX computes flutter with the tangent stiffness of its penalties, which is that of sliding only
under three conditions:
  - The hub turns, so that all points slide. Friction is 0.45 in that step and 0.3 in that of the
    modes: CalculiX gives the points of the second step the friction forces of the first by
    interpolation, and those below the limit would stick.
  - Across the sliding direction friction holds a point with the stick slope. It is small against
    the stiffness of the lining, E / h = 7e11 N/m3, and large enough for the limit to be reached.
  - The turn is small against the cells: stiff penalties between faces that no longer match let go
    of points.
"""
import itertools

import numpy as np

INNER, OUTER, RING, LINING = 0.07, 0.14, 0.012, 0.012  # m: radii, thickness
AROUND, PAD = 24, 4  # cells around the ring, and along a pad
TURN, PRESS = 1e-3, 2e-8  # of the hub, rad, and of the backs of the pads, m
SLOPE = 1e8  # N/m3
FACES = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))  # S1 to S4
EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))


class Grid:
    """Boxes of six tetrahedra with ten nodes each; `places` by node, `index` by node: two per box
    along each direction."""

    def __init__(self, counts, place, closed, first):
        self.index, self.places, self.cells = {}, {}, []
        around = 2 * counts[1]
        number = {}
        for box in np.ndindex(*counts):
            for order in itertools.permutations(range(3)):
                corners = [2 * np.array(box)]
                for direction in order:
                    corners.append(corners[-1] + 2 * np.eye(3, dtype=int)[direction])
                if np.linalg.det([corner - corners[0] for corner in corners[1:]]) < 0:
                    corners[1:3] = corners[2:0:-1]
                row = []
                for at in corners + [(corners[a] + corners[b]) // 2 for a, b in EDGES]:
                    key = at[0], at[1] % around if closed else at[1], at[2]
                    node = number.setdefault(key, first + len(number))
                    self.index[node], self.places[node] = key, place(*(np.array(key) / 2))
                    row.append(node)
                self.cells.append(row)

    def faces(self, chosen, first):
        """Yields the lines of the faces all nodes of which are chosen."""
        for number, row in enumerate(self.cells, first):
            for face, corners in enumerate(FACES, 1):
                if all(chosen(self.index[row[at]]) for at in corners):
                    yield f"{number}, S{face}"

    def nodes(self, chosen):
        return [node for node, index in self.index.items() if chosen(index)]


def _place(radial, around, z):
    angle = 2 * np.pi * around
    return np.array([radial * np.cos(angle), radial * np.sin(angle), z])


def _parts(fine):
    """Returns ring, upper and lower pad."""
    radial, across = 3 * fine, OUTER - INNER

    def ring(i, j, k):
        return _place(INNER + across * i / radial, j / (AROUND * fine), RING * (k / fine - 1))

    def upper(i, j, k):
        height = LINING * k / (2 * fine)
        return _place(INNER + across * (i + fine) / radial, j / (AROUND * fine), height)

    def lower(i, j, k):
        place = upper(i, j, k)
        return np.array([place[0], place[1], -RING - place[2]])

    disc = Grid((radial, AROUND * fine, fine), ring, True, 1)
    counts = (2 * fine, PAD * fine, 2 * fine)
    above = Grid(counts, upper, False, len(disc.places) + 1)
    below = Grid(counts, lower, False, len(disc.places) + len(above.places) + 1)
    # The lower pad is a mirror image, so its cells are inverted until two nodes change places.
    below.cells = [[row[at] for at in (0, 2, 1, 3, 6, 5, 4, 7, 9, 8)] for row in below.cells]
    return disc, above, below


def deck(fine, penalty, frictions=(0.45, 0.3), modes=24):
    """Returns the deck. `fine`: divides the cells; `penalty`: of the contact, N/m3."""
    disc, above, below = parts = _parts(fine)
    names = ("RING", "UPPER", "LOWER")
    lines, first, begin = [], 1, {}
    for name, part in zip(names, parts):
        lines.append(f"*NODE, NSET=N{name}")
        lines += [
            f"{node}, {x:.12e}, {y:.12e}, {z:.12e}" for node, (x, y, z) in part.places.items()
        ]
        lines.append(f"*ELEMENT, TYPE=C3D10, ELSET={name}")
        lines += [
            ", ".join(map(str, [number, *row])) for number, row in enumerate(part.cells, first)
        ]
        begin[name], first = first, first + len(part.cells)
    top, bottom = 2 * fine, 0
    for name, part, own, level in (
        ("RING_UP", disc, "RING", top),
        ("RING_DOWN", disc, "RING", bottom),
        ("PAD_UP", above, "UPPER", 0),
        ("PAD_DOWN", below, "LOWER", 0),
    ):
        lines.append(f"*SURFACE, NAME={name}")
        lines += part.faces(lambda index, level=level: index[2] == level, begin[own])
    hub = disc.nodes(lambda index: index[0] == 0)
    for name, part in (("BACK_UP", above), ("BACK_DOWN", below)):
        lines.append(f"*NSET, NSET={name}")
        lines += map(str, part.nodes(lambda index: index[2] == 4 * fine))
    lines += ["*NSET, NSET=HUB", *map(str, hub)]
    lines += ["*MATERIAL, NAME=IRON", "*ELASTIC", "1.1E11, 0.26", "*DENSITY", "7200."]
    lines += ["*MATERIAL, NAME=LINING", "*ELASTIC", "8.E9, 0.25", "*DENSITY", "2500."]
    lines.append("*SOLID SECTION, ELSET=RING, MATERIAL=IRON")
    lines += [f"*SOLID SECTION, ELSET={name}, MATERIAL=LINING" for name in names[1:]]
    lines += ["*SURFACE INTERACTION, NAME=RUB"]
    lines += ["*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{penalty:g}"]
    lines += ["*FRICTION", f"{frictions[0]:g}, {SLOPE:g}"]
    for pair in ("PAD_UP, RING_UP", "PAD_DOWN, RING_DOWN"):
        lines += ["*CONTACT PAIR, INTERACTION=RUB, TYPE=SURFACE TO SURFACE", pair]
    lines += ["*BOUNDARY", "HUB, 1, 3", "BACK_UP, 1, 2", "BACK_DOWN, 1, 2"]
    lines += ["*STEP", "*STATIC", "*BOUNDARY"]
    lines += [f"BACK_UP, 3, 3, {-PRESS:g}", f"BACK_DOWN, 3, 3, {PRESS:g}"]
    for node in hub:  # numbers of at most 20 characters, which CalculiX reads
        x, y, _ = disc.places[node]
        inwards, along = np.cos(TURN) - 1, np.sin(TURN)
        lines += [f"{node}, 1, 1, {inwards * x - along * y:.11e}"]
        lines += [f"{node}, 2, 2, {along * x + inwards * y:.11e}"]
    lines += ["*END STEP", "*STEP, PERTURBATION", "*CHANGE FRICTION, INTERACTION=RUB"]
    lines += ["*FRICTION", f"{frictions[1]:g}, {SLOPE:g}"]
    lines += ["*FREQUENCY", f"{modes}", "*NODE FILE", "U", "*END STEP"]
    return "\n".join(lines) + "\n"
