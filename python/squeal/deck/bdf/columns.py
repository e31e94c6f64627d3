# SPDX-License-Identifier: BSD-2-Clause
"""Columns of many cards as numpy arrays; texts that need a closer look raise ValueError."""
import numpy as np

WIDEST = 24  # letters of a number; a longer one is left to the slow path


def table_of(rows, width):
    """Returns the fields of cards as a table of `width` columns. Raises ValueError if a card has
    more of them."""
    if any(any(fields[width:]) for fields, _, _ in rows):
        raise ValueError
    padded = [(fields + [""] * width)[:width] for fields, _, _ in rows]
    if max((len(text) for fields in padded for text in fields), default=0) > WIDEST:
        raise ValueError
    return np.array(padded, str).reshape(-1, width)


def _filled(texts, default):
    kind = texts.dtype.kind  # S for bytes, U for text
    blank = texts == (b"" if kind == "S" else "")
    if np.any(blank):
        texts = np.where(blank, np.array(default, kind), texts)
    if kind == "U" and "_" in "".join(texts.tolist()):
        raise ValueError
    return texts


def integers(texts, default="0"):
    return _filled(texts, default).astype(np.int64)


def reals(texts, default="0"):
    values = _filled(texts, default).astype(float)
    if not np.all(np.isfinite(values)):
        raise ValueError
    return values
