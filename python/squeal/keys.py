# SPDX-License-Identifier: BSD-2-Clause
"""The parameters of a sweep, as keys of points."""

PARAMETERS = ("friction", "speed", "pressure", "damping")


def key_of(values):
    """Returns parameters as a key: equal values have equal keys, even if one is a sum,
    such as 0.1 + 0.2, and the other was written as 0.3."""
    return tuple(float(f"{float(value):.12g}") for value in values)


def words_of(at):
    return ", ".join(f"{name} {value:g}" for name, value in at.items())


__all__ = ["PARAMETERS", "key_of", "words_of"]
