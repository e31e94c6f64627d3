# SPDX-License-Identifier: BSD-2-Clause
"""Checks of a model before it is translated."""
import numpy as np

from squeal.deck.journal import Fault
from squeal.deck.mesh import EMPTY


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
                block.source,
                f"element {model.element_label(block.numbers[row])}: there is no node"
                f" {model.node_label(missing)}",
            )
            complete = False
        _check_distinct(block, model, journal)
    numbers = np.concatenate([EMPTY, *(block.numbers for block in model.blocks)])
    for what, known in (("node", model.nodes.numbers), ("element", numbers)):
        if len(known) and known.min() < 1:
            journal.refuse_model(f"{what} {known.min()}: numbers are 1 or more")
            complete = False
    values, counts = np.unique(numbers, return_counts=True)
    if np.any(counts > 1):
        journal.refuse_model(
            f"element {model.element_label(values[counts > 1][0])} is defined twice"
        )
        complete = False
    repeated = model.nodes.repeated
    if len(repeated):
        words = "1 node is" if len(repeated) == 1 else f"{len(repeated)} nodes are"
        such = model.node_label(int(repeated[0]))
        journal.choose(f"{words} defined twice, such as {such}; the last coordinates count")
    _name_absent_members(model, journal)
    return complete


def _name_absent_members(model, journal):
    for what, sets in (("node", model.node_sets), ("element", model.element_sets)):
        for key in sets:
            try:
                members = sets.members(key)
            except Fault:  # refused where it is used
                continue
            if absent := model.absent(members, sets):
                journal.choose(
                    f"the {what} set '{sets.spelled[key]}': left out are {absent} of {len(members)}"
                    " members, which are not in the deck or not translated"
                )


def _check_distinct(block, model, journal):
    """Refuses cells that have a node twice: other programs take them as cells with fewer nodes."""
    if block.shape is None:
        return
    ordered = np.sort(block.nodes, axis=1)
    rows = np.flatnonzero(np.any(ordered[:, 1:] == ordered[:, :-1], axis=1))
    if len(rows):
        label = model.element_label(block.numbers[rows[0]])
        reason = f"element {label} has a node twice; write it as the cell with fewer nodes"
        journal.refuse(block.source, reason)


def check_elements(model, journal):
    """Refuses springs, masses and the like without their properties, and loads of bodies on
    elements that do not exist or are point masses."""
    described = [model.element_sets.members(one.label) for one in (*model.joints, *model.masses)]
    references = [one.reference for one in (*model.means, *model.distributed)]
    for block in model.blocks:
        if block.shape is None and block.kind != "DCOUP3D":
            lacking = np.setdiff1d(block.numbers, np.concatenate([EMPTY, *described]))
            if len(lacking):
                number = model.element_label(lacking[0])
                reason = f"element {number} of type {block.kind} has no stiffness or mass"
                journal.refuse(block.source, reason, block.kind)
        elif block.shape is None and not np.all(np.isin(block.nodes, references)):
            journal.refuse(block.source, "no *DISTRIBUTING COUPLING has this element", block.kind)
    for load in model.state.body_loads:
        _check_load(model, journal, load)


def _check_load(model, journal, load):
    blocks, _ = model.find_elements(load.elements)
    if len(blocks) and np.all(blocks < 0) and not journal.incomplete:
        journal.refuse(
            load.source, f"there is no element {model.element_label(load.elements[0])}", load.kind
        )
    elif np.any(blocks < 0):
        missing = load.elements[blocks < 0]
        journal.remark(load.source, f"{len(missing)} of its elements are not there")
    for number in np.unique(blocks[blocks >= 0]):
        if model.blocks[number].kind == "MASS":
            journal.refuse(load.source, "body loads on point masses are not supported", load.kind)
