# SPDX-License-Identifier: BSD-2-Clause
"""Pieces of bodies: cells with one section, and the body that those sharing nodes make up.

A part with several sections is one body, since motion, contact and the count of loose parts belong
to the body; a material belongs to the section.
"""
from dataclasses import dataclass

import numpy as np

from squeal.deck.mesh import EMPTY


@dataclass
class Piece:
    """`cells`: numbers of elements; `instance`: that of an assembly, −1 without one; `loads`: the
    numbers of the body loads that act on it; `density`: where these depend on it."""

    section: int
    reduced: bool
    instance: int
    loads: tuple
    cells: np.ndarray
    density: float = None


def instances_of(model, numbers):
    """Returns for each element the number of its instance, −1 for those of the model."""
    ends = [one.last_element for one in model.instances]
    found = np.searchsorted(ends, numbers)
    return np.where(found < len(ends), found, -1)


def bodies_of(pieces, model):
    """Returns lists of pieces that form one body: they share nodes, directly or by others, and have
    equal loads."""
    alike = {}
    for piece in pieces:
        alike.setdefault((piece.loads, piece.density), []).append(piece)
    return [body for some in alike.values() for body in _connected(some, model)]


def _connected(pieces, model):
    if len(pieces) == 1:
        return [pieces]
    tables = [model.nodes_of_elements(piece.cells) for piece in pieces]
    owners = np.repeat(np.arange(len(pieces)), [len(table) for table in tables])
    nodes = np.concatenate([EMPTY, *tables])
    order = np.argsort(nodes, kind="stable")
    nodes, owners = nodes[order], owners[order]
    shared = nodes[1:] == nodes[:-1]
    body = np.arange(len(pieces))
    for pair in np.unique(np.column_stack([owners[:-1], owners[1:]])[shared], axis=0):
        first, second = body[pair]
        body[body == second] = first
    found = {}
    for piece, number in zip(pieces, body.tolist()):
        found.setdefault(number, []).append(piece)
    return found.values()
