# SPDX-License-Identifier: BSD-2-Clause
"""Numbers of decks: an exponent may have the letter D or none, a real number may be an integer."""
import math
import re

import numpy as np

from squeal.deck.journal import Fault

REAL = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+))(?:[eEdD]([+-]?\d+)|([+-]\d+))?")
LARGEST = 2**53  # of integers: below, a real number is exact as well
LONGEST = 20_000_000  # of ranges of numbers
INTEGER = re.compile(r"[+-]?\d+\.?0*")


def real(text, line=None):
    """Returns the number that a text is. Raises Fault."""
    match = REAL.fullmatch(text.strip())
    if not match:
        raise Fault(f"'{text.strip()}' is not a number", line=line)
    digits, exponent, bare = match.groups()
    value = float(f"{digits}e{exponent or bare or 0}")
    if not math.isfinite(value):
        raise Fault(f"'{text.strip()}' is too large", line=line)
    return value


def integer(text, line=None):
    """Returns the integer that a text is. Raises Fault."""
    if not INTEGER.fullmatch(text.strip()):
        raise Fault(f"'{text.strip()}' is not an integer", line=line)
    value = int(text.strip().split(".")[0])
    if abs(value) > LARGEST:
        raise Fault(f"'{text.strip()}' is too large", line=line)
    return value


def table(words, kind):
    """Returns an array of numbers, given as a list of words. Raises ValueError for words that
    Python reads as numbers but decks do not, such as 1_2."""
    joined = "".join(words)
    if "_" in joined or not joined.isascii():
        raise ValueError(joined)
    return np.array(words, dtype=kind)


def is_integer(text):
    return re.fullmatch(r"[+-]?\d+", text.strip()) is not None
