# SPDX-License-Identifier: BSD-2-Clause
"""Rigid elements: RBE2 and RBAR become rigid couplings, RBE3 distributed ones or equations."""
import numpy as np

from squeal.deck.attachments import Distributed
from squeal.deck.bdf.handlers import handles
from squeal.deck.journal import TRANSLATED, UNUSED, Fault
from squeal.deck.model import Equation, Rigid

ALL = (0, 1, 2, 3, 4, 5)


@handles("RBE2", phase=1)
def rbe2(card, reader):
    number, independent, components = card.identifier(1), card.identifier(2), card.components(3)
    _skip_expansion(card, reader, 4)
    nodes = reader.grids_in(card.numbers(4), card)
    if not len(nodes):
        raise Fault("no dependent grid is named", line=card.line)
    _rigid(card, reader, f"rbe2_{number}", independent, components, nodes)


@handles("RBAR", phase=1)
def rbar(card, reader):
    number, ends = card.identifier(1), (card.identifier(2), card.identifier(3))
    free = [card.components(at, ()) for at in (4, 5)]
    held = [card.components(at, ()) for at in (6, 7)]
    if not any(free):
        free[0] = ALL
    _skip_expansion(card, reader, 8)
    for first, second in ((0, 1), (1, 0)):
        if free[first] == ALL and not free[second] and not held[first]:
            nodes = reader.grids_in([(ends[second], ends[second])], card)
            _rigid(card, reader, f"rbar_{number}", ends[first], held[second] or ALL, nodes)
            return
    raise Fault("all independent components must belong to one end; use MPC", line=card.line)


def _skip_expansion(card, reader, first):
    """The last fields may be ALPHA and TREF, real numbers."""
    for at in range(first, len(card.fields) + 1):
        text = card.fields[at - 1]
        if "." in text:
            card.real(at)
            card.fields[at - 1] = ""
            reader.journal.remark(card.source, "expansion is not used: temperatures are refused")


def _rigid(card, reader, name, independent, components, nodes):
    """Adds a rigid coupling for the nodes of each frame, since components have the axes of their
    nodes; rotations of nodes of solid cells do not exist."""
    model = reader.model
    model.nodes.at([independent])
    if independent in nodes:
        raise Fault(f"grid {independent} depends on itself", line=card.line)
    moved = tuple(at for at in components if at < 3)
    turned = tuple(at for at in components if at > 2)
    outside = nodes[~reader.in_cells(nodes)]
    if len(outside) and 0 < len(turned) < 3 or len(outside) and not moved:
        raise Fault(
            f"some rotations of grid {outside[0]} are not supported; use MPC", line=card.line
        )
    if not moved:
        reader.journal.mark(
            card.source, UNUSED, "rotations of nodes of solid elements do not exist"
        )
        return
    parts = {0: (None, nodes)}
    if len(moved) < 3:
        parts = {}
        for node in nodes.tolist():
            frame = model.frames.get(node)
            parts.setdefault(id(frame), (frame, []))[1].append(node)
    if reader.in_cells(np.array([independent]))[0]:
        _stand_for(card, reader, independent)
    for count, (frame, numbers) in enumerate(parts.values(), 1):
        own = name if count == 1 else f"{name}_{count}"
        numbers = np.array(numbers, np.int64)
        model.node_sets.add(own.upper(), own, card.source, [numbers])
        pinned = len(turned) == 0 and len(outside) > 0
        one = Rigid(own.upper(), numbers, independent, card.source, name=own, pinned=pinned)
        one.components, one.frame = moved, frame
        model.rigid.append(one)
    reader.journal.mark(card.source, TRANSLATED)


def _stand_for(card, reader, grid):
    """A grid of solid cells with rotations becomes a reference node that its cells follow."""
    if grid in reader.doubled:
        return
    reader.doubled.add(grid)
    name = f"grid_{grid}"
    reader.model.node_sets.add(name.upper(), name, card.source, [np.array([grid], np.int64)])
    reader.model.rigid.append(
        Rigid(name.upper(), np.array([grid], np.int64), grid, card.source, name=name)
    )


@handles("RBE3", phase=1)
def rbe3(card, reader):
    """The reference grid follows the mean motion of grids, with weights for their components."""
    number, reference, wanted = card.identifier(1), card.identifier(3), card.components(4)
    parts = _parts(card, reader)
    reader.model.nodes.at([reference])
    if any(max(components) > 2 for _, components, _ in parts):
        raise Fault(
            "rotations of the grids (components 4 to 6 of C) are not supported", line=card.line
        )
    nodes = np.concatenate([numbers for _, _, numbers in parts])
    weights = np.concatenate([np.full(len(numbers), weight) for weight, _, numbers in parts])
    if np.any(weights <= 0):
        raise Fault("the weights must be positive", line=card.line)
    full = all(components == (0, 1, 2) for _, components, _ in parts)
    inside = reader.in_cells(np.array([reference]))[0]
    if full and wanted == ALL and not inside:
        unique, inverse = np.unique(nodes, return_inverse=True)
        total = np.zeros(len(unique))
        np.add.at(total, inverse, weights)
        name = f"rbe3_{number}"
        one = Distributed(name, reference, unique, total, card.source)
        reader.model.distributed.append(one)
        return
    if inside and max(wanted) > 2:
        raise Fault(f"grid {reference} of solid elements has no rotations", line=card.line)
    components = [chosen for _, chosen, numbers in parts for _ in numbers]
    _mean_equations(card, reader, (number, reference, wanted), nodes, weights, components)


def _parts(card, reader):
    """Returns weight, components and grids of each group."""
    parts, at, last = [], 5, len(card.fields)
    while at <= last:
        word = card.word(at)
        if word == "UM":
            reader.journal.remark(
                card.source, "UM is not used: it chooses unknowns, and the equations are the same"
            )
            while at <= last and card.word(at) != "ALPHA":
                at += 1
        elif word == "ALPHA":
            card.real(at + 1, 0.0), card.real(at + 2, 0.0)
            reader.journal.remark(card.source, "expansion is not used: temperatures are refused")
            at += 3
        elif not word:
            at += 1
        elif "." in word or at == 5:
            parts.append((card.real(at), card.components(at + 1), []))
            at += 2
        elif not parts:
            raise Fault("the first weight is missing", line=card.line)
        else:
            parts[-1][2].append(card.identifier(at))
            at += 1
    if not parts or any(not numbers for _, _, numbers in parts):
        raise Fault("a weight has no grids", line=card.line)
    return [
        (weight, components, reader.grids_in([(one, one) for one in numbers], card))
        for weight, components, numbers in parts
    ]


def _mean_equations(card, reader, names, nodes, weights, components):
    """The motion of the reference minimises the weighted squares of the differences of components,
    Σ w (e·(u − U − θ × r))². Its wanted components are equations."""
    number, reference, wanted = names
    model = reader.model
    arms = model.nodes.at(nodes) - model.nodes.at([reference])[0]
    length = np.max(np.linalg.norm(arms, axis=1)) or 1.0
    matrix, columns = np.zeros((6, 6)), np.zeros((6, 3 * len(nodes)))
    for row, (node, weight, chosen) in enumerate(zip(nodes.tolist(), weights, components)):
        axes = reader.axes_at(node)
        for at in chosen:
            form = np.concatenate([axes[at], np.cross(arms[row] / length, axes[at])])
            matrix += weight * np.outer(form, form)
            columns[:, 3 * row : 3 * row + 3] += weight * np.outer(form, axes[at])
    if np.linalg.cond(matrix) > 1e12:
        raise Fault("the components of the grids do not determine the motion", line=card.line)
    motion = np.linalg.solve(matrix, columns)
    motion[3:] /= length
    axes = reader.axes_at(reference)
    for at in wanted:
        block, axis = (0, axes[at]) if at < 3 else (3, axes[at - 3])
        terms = [(reference, block + one, axis[one]) for one in range(3) if axis[one]]
        row = axis @ motion[block : block + 3]
        bound = 1e-14 * np.max(np.abs(row))
        for place, value in enumerate(row):
            if abs(value) > bound:
                terms.append((int(nodes[place // 3]), place % 3, -float(value)))
        name = f"rbe3_{number}_{at + 1}"
        model.equations.append(Equation(terms, card.source, True, name))
