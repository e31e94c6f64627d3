# SPDX-License-Identifier: BSD-2-Clause
"""Checks of the mesh of a model before it is translated."""
import numpy as np

from squeal.deck.model import EMPTY


def check_mesh(model, journal):
    """Refuses elements without their nodes and equal numbers of elements, and names nodes that are
    given twice. Returns whether the mesh is complete."""
    complete = True
    for block in model.blocks:
        there = model.nodes.has(block.nodes)
        if not np.all(there):
            row = np.flatnonzero(~np.all(there, axis=1))[0]
            missing = block.nodes[row][~there[row]][0]
            journal.refuse(
                block.source, f"element {block.numbers[row]}: there is no node {missing}"
            )
            complete = False
    numbers = np.concatenate([EMPTY, *(block.numbers for block in model.blocks)])
    for what, known in (("node", model.nodes.numbers), ("element", numbers)):
        if len(known) and known.min() < 1:
            journal.refuse_model(f"{what} {known.min()}: numbers are 1 or more")
            complete = False
    values, counts = np.unique(numbers, return_counts=True)
    if np.any(counts > 1):
        journal.refuse_model(f"element {values[counts > 1][0]} is defined twice")
        complete = False
    repeated = model.nodes.repeated
    if repeated:
        words = "1 node is" if repeated == 1 else f"{repeated} nodes are"
        journal.choose(f"{words} defined twice; the last coordinates count")
    return complete
