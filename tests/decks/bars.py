# SPDX-License-Identifier: BSD-2-Clause
"""Decks of a skewed bar, made here for cards that the decks of CalculiX's package do not have."""
import numpy as np

CELLS = (2, 2, 4)


def _points():
    """Returns the numbers and places of the nodes of hexahedra with 20 nodes, and the elements."""
    counts = [2 * count + 1 for count in CELLS]
    number, places, elements = {}, [], []
    for k in range(counts[2]):
        for j in range(counts[1]):
            for i in range(counts[0]):
                if (i % 2) + (j % 2) + (k % 2) <= 1:
                    number[i, j, k] = len(number) + 1
                    x, y, z = i / 4, j / 4, k / 2
                    places.append((x + 0.05 * y * z, y - 0.04 * x * z, z + 0.1 * x - 0.1 * y * x))
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
    for k in range(CELLS[2]):
        for j in range(CELLS[1]):
            for i in range(CELLS[0]):
                row = [number[2 * i + a, 2 * j + b, 2 * k + c] for a, b, c in local]
                elements.append(row)
    return number, places, elements


def _lines(numbers, width=10):
    words = [str(one) for one in numbers]
    return [", ".join(words[at : at + width]) + "," for at in range(0, len(words), width)]


def mesh(kind="C3D20"):
    """Returns the cards of the mesh: node sets ROOT, TIP, INSIDE; element sets LOW, HIGH, ALL; the
    surface CAP of the faces at the tip."""
    number, places, elements = _points()
    lines = ["*NODE, NSET=NODES"]
    lines += [f"{at}, {x!r}, {y!r}, {z!r}" for at, (x, y, z) in enumerate(places, 1)]
    lines += [f"*ELEMENT, TYPE={kind}, ELSET=ALL"]
    for at, row in enumerate(elements, 1):
        lines += _lines([at, *row])
    last = 2 * CELLS[2]
    for name, chosen in (
        ("ROOT", lambda i, j, k: k == 0),
        ("TIP", lambda i, j, k: k == last),
        ("SIDE", lambda i, j, k: i == 0 and k > 0),
    ):
        lines += [f"*NSET, NSET={name}", *_lines(n for at, n in number.items() if chosen(*at))]
    half = len(elements) // 2
    lines += ["*ELSET, ELSET=LOW, GENERATE", f"1, {half}"]
    lines += ["*ELSET, ELSET=HIGH, GENERATE", f"{half + 1}, {2 * half}"]
    lines += ["*ELSET, ELSET=END, GENERATE", f"{2 * half - 3}, {2 * half}"]
    lines += ["*SURFACE, NAME=CAP", "END, S2"]
    return "\n".join(lines) + "\n"


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
}
