# SPDX-License-Identifier: BSD-2-Clause
"""Decks of a skewed bar, made here for cards that the decks of CalculiX's package do not have."""
import numpy as np


def _skewed(x, y, z):
    return x + 0.05 * y * z, y - 0.04 * x * z, z + 0.1 * x - 0.1 * y * x


def grid(cells, size, place, first=1):
    """Returns the numbers of the nodes of hexahedra with 20 nodes by their indices (two per cell),
    their places, and the nodes of the elements. `size`: of the box before `place` maps its points;
    `first`: number of the first node."""
    counts = [2 * count + 1 for count in cells]
    number, places, elements = {}, [], []
    for k in range(counts[2]):
        for j in range(counts[1]):
            for i in range(counts[0]):
                if (i % 2) + (j % 2) + (k % 2) <= 1:
                    number[i, j, k] = first + len(number)
                    part = [at / (2 * count) for at, count in zip((i, j, k), cells)]
                    places.append(place(*(one * length for one, length in zip(part, size))))
    corners = [
        (0, 0, 0),
        (2, 0, 0),
        (2, 2, 0),
        (0, 2, 0),
        (0, 0, 2),
        (2, 0, 2),
        (2, 2, 2),
        (0, 2, 2),
    ]
    edges = "01 12 23 30 45 56 67 74 04 15 26 37".split()
    local = corners + [
        tuple((np.array(corners[int(a)]) + np.array(corners[int(b)])) // 2) for a, b in edges
    ]
    for k in range(cells[2]):
        for j in range(cells[1]):
            for i in range(cells[0]):
                elements.append([number[2 * i + a, 2 * j + b, 2 * k + c] for a, b, c in local])
    return number, places, elements


def _lines(numbers, width=10):
    words = [str(one) for one in numbers]
    return [", ".join(words[at : at + width]) + "," for at in range(0, len(words), width)]


def _cards(number, places, elements, first=1, kind="C3D20"):
    """Returns the lines of nodes and elements; `first`: number of the first element."""
    lines = ["*NODE, NSET=NODES"]
    lines += [f"{at}, {x!r}, {y!r}, {z!r}" for at, (x, y, z) in zip(number.values(), places)]
    lines += [f"*ELEMENT, TYPE={kind}, ELSET=ALL"]
    for at, row in enumerate(elements, first):
        lines += _lines([at, *row])
    return lines


def _set(name, number, chosen):
    """Returns the lines of a set of the nodes whose indices are chosen."""
    return [f"*NSET, NSET={name}", *_lines(one for at, one in number.items() if chosen(*at))]


def mesh(kind="C3D20"):
    """Returns the cards of the mesh: node sets ROOT, TIP, SIDE; element sets LOW, HIGH, END, ALL;
    the surface CAP of the faces at the tip."""
    number, places, elements = grid((2, 2, 4), (1, 1, 4), _skewed)
    lines = _cards(number, places, elements, kind=kind)
    lines += _set("ROOT", number, lambda i, j, k: k == 0)
    lines += _set("TIP", number, lambda i, j, k: k == 8)
    lines += _set("SIDE", number, lambda i, j, k: i == 0 and k > 0)
    half = len(elements) // 2
    lines += ["*ELSET, ELSET=LOW, GENERATE", f"1, {half}"]
    lines += ["*ELSET, ELSET=HIGH, GENERATE", f"{half + 1}, {2 * half}"]
    lines += ["*ELSET, ELSET=END, GENERATE", f"{2 * half - 3}, {2 * half}"]
    lines += ["*SURFACE, NAME=CAP", "END, S2"]
    return "\n".join(lines) + "\n"


def tied(gap, words="", left=0.02):
    """Returns the deck of two bars whose faces meet with different cells, curved like a saddle,
    with a gap, a function of x and y. The nodes of the upper bar, which begins at x = left, are
    tied to faces of the lower one."""

    def saddle(x, y, z):
        return x, y, z + 0.05 * (x - 0.4) ** 2 - 0.08 * x * y

    number, places, elements = grid((2, 2, 2), (1, 1, 2), saddle)
    lines = _cards(number, places, elements) + _set("ROOT", number, lambda i, j, k: k == 0)
    lines += ["*SURFACE, NAME=LOWER", *(f"{at}, S2" for at in range(5, 9))]

    def above(x, y, z):
        x, y, z = saddle(left + 0.95 * x, 0.01 + 0.96 * y, z)
        return x, y, z + 2 + gap(x, y)

    number, places, elements = grid((3, 1, 1), (1, 1, 1), above, 501)
    lines += _cards(number, places, elements, 101)
    lines += _set("FEET", number, lambda i, j, k: k == 0)
    lines += _set("TIP", number, lambda i, j, k: k == 2)
    lines += ["*SURFACE, NAME=UPPER, TYPE=NODE", "FEET", f"*TIE, NAME=GLUE{words}", "UPPER, LOWER"]
    step = f"*STEP\n*STATIC\n{PULL}*END STEP\n"
    return "\n".join(lines) + "\n" + STEEL + SECTION + ROOT + step + FREQUENCY


STEEL = """*MATERIAL, NAME=STEEL
*ELASTIC
210000., 0.3
*DENSITY
7.8E-9
"""
SECTION = "*SOLID SECTION, ELSET=ALL, MATERIAL=STEEL\n"
ROOT = "*BOUNDARY\nROOT, 1, 3\n"
PULL = "*CLOAD\nTIP, 1, 3.\nTIP, 3, 1.\n"
FREQUENCY = "*STEP\n*FREQUENCY\n6\n*END STEP\n"


def deck(model, step="", sections=STEEL + SECTION, held=ROOT, after=FREQUENCY):
    static = f"*STEP\n*STATIC\n{step}*END STEP\n" if step else ""
    return mesh() + sections + held + model + static + after


LOOSE = "*NODE\n900, 0.3, 0.4, 5.\n901, 0.3, 0.4, 5.\n902, 2., 0.4, 3.\n903, 0.3, 0.4, 6.\n"
TURNED = "*TRANSFORM, NSET=TIP, TYPE=R\n0.6, 0.8, 0., -0.8, 0.6, 0.\n"
ROUND = "*TRANSFORM, NSET=SIDE, TYPE=C\n-3., 0., 0., -3., 0.1, 2.\n"
COUPLING = LOOSE + "*COUPLING, REF NODE=900, SURFACE=CAP, CONSTRAINT NAME=JOINT{}\n"
CONSTANTS = """*MATERIAL, NAME=WOOD
*ELASTIC, TYPE=ENGINEERING CONSTANTS
13000., 900., 600., 0.4, 0.35, 0.45, 800., 700.,
90.
*DENSITY
5.E-10
*ORIENTATION, NAME=GRAIN
0., 0.2, 1., 1., 0., 0.
*ORIENTATION, NAME=ACROSS
1., 0.3, 0., 0., 1., 0.
*SOLID SECTION, ELSET=LOW, MATERIAL=WOOD, ORIENTATION=GRAIN
*SOLID SECTION, ELSET=HIGH, MATERIAL=WOOD, ORIENTATION=ACROSS
"""
STRUT = (
    LOOSE
    + "*ELEMENT, TYPE=SPRINGA, ELSET=STRUT\n901, 90, 902\n"
    + "*ELEMENT, TYPE=SPRING1, ELSET=SOIL\n902, 100\n*ELEMENT, TYPE=MASS, ELSET=LUMP\n903, 101\n"
    + "*SPRING, ELSET=STRUT\n\n2000.\n*SPRING, ELSET=SOIL\n2\n500.\n*MASS, ELSET=LUMP\n2.E-8\n"
    + "*BOUNDARY\n902, 1, 3\n"
)
DECKS = {
    "two sections with axes of their own": deck("", PULL, CONSTANTS),
    "slanted support and force in turned axes": deck(
        TURNED, "*BOUNDARY\nTIP, 2, 2, 0.01\n*CLOAD\nTIP, 1, 3.\n"
    ),
    "prescribed values in cylindrical axes": deck(
        ROUND, "*BOUNDARY\nSIDE, 1, 1, 0.001\n" + PULL, after=""
    ),
    "rigid tip that is turned": deck(
        LOOSE + "*RIGID BODY, NSET=TIP, REF NODE=900, ROT NODE=901\n",
        "*BOUNDARY\n901, 1, 1, 0.01\n*CLOAD\n900, 1, 5.\n901, 3, 7.\n",
        after="",
    ),
    "rigid tip, free": deck(LOOSE + "*RIGID BODY, NSET=TIP, REF NODE=900, ROT NODE=901\n"),
    "coupling with a moment": deck(
        COUPLING.format("") + "*KINEMATIC\n1, 3\n", "*CLOAD\n900, 1, 5.\n900, 5, 7.\n"
    ),
    "coupling of some components": deck(
        COUPLING.format("") + "*KINEMATIC\n1\n3, 3\n",
        "*CLOAD\n900, 1, 5.\n*BOUNDARY\n900, 4, 5\n900, 6, 6, 0.01\n",
        after="",
    ),
    "coupling in turned axes": deck(
        "*ORIENTATION, NAME=TURNED\n0.6, 0.8, 0., -0.8, 0.6, 0.\n"
        + COUPLING.format(", ORIENTATION=TURNED")
        + "*KINEMATIC\n1, 1\n",
        "*CLOAD\n900, 1, 5.\nTIP, 2, 1.\n*BOUNDARY\n900, 2, 6\n",
        after="",
    ),
    "coupling in cylindrical axes": deck(
        "*ORIENTATION, NAME=ROUND, SYSTEM=CYLINDRICAL\n-1., 0., 0., -1., 0., 1.\n"
        + COUPLING.format(", ORIENTATION=ROUND")
        + "*KINEMATIC\n1, 2\n",
        "*CLOAD\n900, 1, 5.\nTIP, 2, 1.\n*BOUNDARY\n900, 2, 6\n",
        after="",
    ),
    "equations with a node outside": deck(
        TURNED + LOOSE + "*NSET, NSET=ONE\n2\n*EQUATION\n"
        "3\n902, 1, 2., 90, 2, -1., 60, 1, 0.5\n2\n903, 3, 1., 902, 1, -3.\n",
        PULL + "903, 3, -4.\n",
    ),
    # CalculiX turns SPRINGA with the displacements of a static step before the frequencies.
    "strut, ground spring and point mass": deck(STRUT, PULL, after=""),
    "strut, ground spring and point mass, free": deck(STRUT),
    "pressure on a surface, two steps": deck(
        "",
        PULL + "*DLOAD\nEND, P2, 3.\nLOW, GRAV, 9810., 1., 2., -2.\n*END STEP\n"
        "*STEP\n*STATIC\n*DSLOAD\nCAP, P, 7.\n*CLOAD\nTIP, 3, 2.\n",
    ),
    "spins of two halves": deck(
        "",
        "*DLOAD\nLOW, CENTRIF, 1.E6, 0., 0., 0., 0., 1., 0.\n"
        "HIGH, CENTRIF, 4.E6, 1., 0., 0., 0., 0.6, 0.8\n",
    ),
    "amplitudes of two steps": deck(
        "*AMPLITUDE, NAME=A\n0., 0., 4., 2.\n*AMPLITUDE, NAME=B, TIME=TOTAL TIME\n0., 0., 4., 1.\n",
        "*CLOAD, AMPLITUDE=A\nTIP, 1, 2.\n*END STEP\n"
        "*STEP\n*STATIC\n1., 3.\n*CLOAD, AMPLITUDE=B\nTIP, 2, 3.\n"
        "*DLOAD, AMPLITUDE=A\nLOW, GRAV, 9810., 1., 2., -2.\nEND, P2, 3.\n"
        "*BOUNDARY, AMPLITUDE=A\nSIDE, 1, 1, 1.E-4\n",
    ),
    "constants between two temperatures": deck(
        "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNODES, 45.\n",
        PULL,
        STEEL.replace("0.3\n", "0.3, 20.\n1.E5, 0.4, 120.\n") + SECTION,
    ),
    "tie of nodes to a saddle": tied(lambda x, y: 0.0),
    "tie of nodes, some of them too far away": tied(lambda x, y: 0.001 + 0.002 * x + 0.001 * y),
    "tie of nodes, not moved": tied(lambda x, y: 0.002, ", ADJUST=NO"),
    "tie of nodes beyond the edge": tied(lambda x, y: 0.001, "", -0.0015),
    "tie of nodes with a tolerance": tied(lambda x, y: 0.1, ", POSITION TOLERANCE=0.2"),
}
