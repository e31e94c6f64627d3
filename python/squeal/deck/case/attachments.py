# SPDX-License-Identifier: BSD-2-Clause
"""Bushings, distributed couplings and point masses with inertia of a case."""
import numpy as np

from squeal.deck.case.groups import NODES, clean
from squeal.deck.journal import TRANSLATED, Fault, Missing

DIGITS = 30  # binary ones of weights


def add_attachments(model, roles, case, journal):
    """A fault of one of them does not keep the others from being translated."""
    for translate, ones in (
        (_bushing, model.bushings),
        (add_distributed, model.distributed),
        (_inertia, [one for one in model.inertias if one.node in roles.references]),
    ):
        for one in ones:
            try:
                translate(one, model, roles, case)
                journal.mark(one.source, TRANSLATED)
            except Fault as fault:
                journal.refuse_fault(one.source, fault)
    _masses_of_cells(model, roles, case, journal)


def _bushing(one, model, roles, case):
    path = ("bushing", clean(one.name))
    for key, number in (("from", one.first), ("to", one.second)):
        if number is None:
            continue
        for component in one.components():
            roles.place(number, component)
        case.set((*path, key), roles.name(number), one.source)
    for key, values in (("stiffness", one.stiffness), ("damping", one.damping)):
        if np.any(values):
            case.set((*path, key), values if np.any(values[3:]) else values[:3], one.source)
    if one.frame is not None:
        case.set((*path, "frame"), case.frame(one.frame), one.source)


def of_equal_weight(nodes, weights):
    """Yields parts of the nodes and their weights. Those of a node in several parts add up: many
    different weights are written as sums of powers of two."""
    if not len(nodes):
        return
    relative = weights / np.max(weights)
    _, first, kinds = np.unique(np.round(relative, 12), return_index=True, return_inverse=True)
    if len(first) <= DIGITS:
        for kind, at in enumerate(first):
            yield nodes[kinds == kind], weights[at]
        return
    digits = np.round(relative * 2.0**DIGITS).astype(np.int64)
    for digit in range(DIGITS, -1, -1):
        chosen = nodes[(digits >> digit) % 2 == 1]
        if len(chosen):
            yield chosen, 2.0 ** (digit - DIGITS)


def add_distributed(one, model, roles, case):
    """Nodes of equal weight are a group, except reference nodes."""
    if one.reference not in roles.references:
        label = model.node_label(one.reference)
        raise Fault(f"the reference node {label} belongs to solid cells")
    parts, weights = [], []
    inside = np.array([roles.in_cells(number) for number in one.nodes.tolist()], bool)
    for chosen, weight in of_equal_weight(one.nodes[inside], one.weights[inside]):
        parts.append(case.group(NODES, chosen, one.label or f"{one.name}_nodes"))
        weights.append(weight)
    for number, weight in zip(one.nodes[~inside].tolist(), one.weights[~inside]):
        roles.place(number, 0)
        parts.append(roles.name(number))
        weights.append(weight)
    if not parts:
        raise Missing("none of its nodes belongs to an element that is translated")
    path = ("coupling", clean(one.name))
    case.set((*path, "kind"), "distributed", one.source)
    case.set((*path, "reference"), roles.references[one.reference], one.source)
    case.set((*path, "nodes"), ",".join(parts), one.source)
    if len(set(weights)) > 1:
        case.set((*path, "weights"), weights, one.source)


def _inertia(one, model, roles, case):
    path = ("mass", roles.references[one.node])
    if one.mass <= 0:
        raise Fault("a point mass must be positive")
    case.set((*path, "total"), one.mass, one.source)
    if np.any(one.offset):
        case.set((*path, "offset"), one.offset, one.source)
    if np.any(one.inertia):
        places = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
        case.set((*path, "inertia"), [one.inertia[place] for place in places], one.source)


def _masses_of_cells(model, roles, case, journal):
    """The total of a group is shared equally by its nodes: nodes of equal mass are one group."""
    buckets = {}
    for one in model.inertias:
        if one.node in roles.references:
            continue
        try:
            roles.place(one.node, 0)
            if one.turns:
                raise Fault(
                    f"node {one.node} of solid cells has no rotations, which the offset or the"
                    " inertia of this mass needs"
                )
            if one.mass <= 0:
                raise Fault("a point mass must be positive")
            buckets.setdefault(one.mass, []).append(one)
        except Fault as fault:
            journal.refuse_fault(one.source, fault)
    for mass, ones in buckets.items():
        first = ones[0]
        name = case.group(NODES, [one.node for one in ones], first.name)
        case.set(("mass", name, "total"), mass * len(ones), first.source)
        for one in ones:
            journal.mark(one.source, TRANSLATED)
