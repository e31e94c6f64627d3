# SPDX-License-Identifier: BSD-2-Clause
"""Names of rows: node and component, both in one integer, the key of a row."""
import re

import numpy as np

from squeal.deck.journal import Fault

SPAN = 64  # more than the largest component
LARGEST_NODE = 2**53 // SPAN
# Names of Ansys: the first six have the numbers of the other programs. The numbers of the others
# are beyond those of Abaqus, which go up to 30.
ANSYS = ("UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ")
ANSYS_OTHERS = ("TEMP", "PRES", "VOLT", "MAG", "AX", "AY", "AZ", "WARP", "HDSP", "CURR", "EMF")
FIRST_OTHER = 40


def keys_of(nodes, components):
    return nodes * SPAN + components


def require_components(components, lines):
    """Raises Fault for a component out of range; `lines`: returns the line of an entry."""
    wrong = (components < 0) | (components >= FIRST_OTHER)
    if np.any(wrong):
        at = int(np.argmax(wrong))
        raise Fault(f"{components[at]:.0f} is not a degree of freedom", line=lines(at))


def nodes_of(keys):
    return keys // SPAN


def components_of(keys):
    """Returns the names of components: numbers, or those of Ansys."""
    numbers = keys - (keys // SPAN) * SPAN
    names = np.array([str(number) for number in range(SPAN)], dtype=object)
    names[FIRST_OTHER : FIRST_OTHER + len(ANSYS_OTHERS)] = ANSYS_OTHERS
    return names[numbers]


def component_number(word):
    """Returns the number of a component, given as a number or by its name of Ansys, or None."""
    word = word.upper()
    if re.fullmatch(r"\d{1,2}", word) and int(word) < FIRST_OTHER:
        return int(word)
    if word in ANSYS:
        return ANSYS.index(word) + 1
    if word in ANSYS_OTHERS:
        return FIRST_OTHER + ANSYS_OTHERS.index(word)
    return None


class Rows:
    """The rows of a case: `keys` of nodes and components or None, and the numbers from 1 in the
    files of matrices without such labels."""

    def __init__(self, size, keys=None):
        self.size, self.keys = size, keys
        self.numbers = np.arange(1, size + 1)

    def restricted(self, kept):
        rows = Rows(int(np.sum(kept)), None if self.keys is None else self.keys[kept])
        rows.numbers = self.numbers[kept]
        return rows

    def words(self, chosen, most=5):
        """Returns the names of some rows, chosen by a mask."""
        places = np.flatnonzero(chosen)
        found = [self.word(place) for place in places[:most]]
        return "; ".join(found) + ("; …" if len(places) > most else "")

    def word(self, place):
        if self.keys is None:
            return f"row {self.numbers[place]}"
        return words_of_key(self.keys[place])


def words_of_key(key):
    one = np.array([key])
    return f"node {nodes_of(one)[0]} component {components_of(one)[0]}"
