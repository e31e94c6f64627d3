# SPDX-License-Identifier: BSD-2-Clause
"""Columns of many cards as numpy arrays; texts that need a closer look raise ValueError."""
import itertools

import numpy as np

CHUNK = 20000  # cards that are converted together
WIDEST = 24  # letters of a number; a longer one is left to the slow path


def chunks(rows):
    """Yields lists of rows."""
    rows = iter(rows)
    while chunk := list(itertools.islice(rows, CHUNK)):
        yield chunk


def _array(texts, default):
    filled = [text or default for text in texts]
    if max(map(len, filled), default=0) > WIDEST or "_" in "".join(filled):
        raise ValueError
    return np.array(filled)


def integers(texts, default="0"):
    return _array(texts, default).astype(np.int64)


def reals(texts, default="0"):
    values = _array(texts, default).astype(float)
    if not np.all(np.isfinite(values)):
        raise ValueError
    return values
