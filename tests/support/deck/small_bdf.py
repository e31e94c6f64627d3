# SPDX-License-Identifier: BSD-2-Clause
"""Small decks of Nastran for tests, and their import."""
from small_decks import Imported, refused

POINTS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
STEEL = "PSOLID,1,1\nMAT1,1,210000.,,0.3,7.8-9\n"
CUBE = "".join(f"GRID,{at},,{x:g}.,{y:g}.,{z:g}.\n" for at, (x, y, z) in enumerate(POINTS, 1))
CUBE += "CHEXA,1,1,1,2,3,4,5,6,\n,7,8\n"
HELD = "SPC1,10,123,1,THRU,4\n"
CONTROL = "SOL 101\nCEND\nSPC = 10\nLOAD = 20\nBEGIN BULK\n"


def cube(cards="", control=CONTROL, held=HELD):
    """Returns the deck of a cube of steel on a clamped face, with more cards."""
    return control + CUBE + STEEL + held + cards + "ENDDATA\n"


def force(vector="0.,0.,1.", grid=5):
    return f"FORCE,20,{grid},,1.,{vector}\n"


def imported(text, files=(), **words):
    return Imported(text, files, "deck.bdf", **words)


def refusals(text, files=(), **words):
    return refused(text, files, deck="deck.bdf", **words)
