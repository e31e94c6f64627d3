# SPDX-License-Identifier: BSD-2-Clause
"""Cards that generate nodes and elements from others."""
import numpy as np

from squeal.deck.inp.assembly import position_of
from squeal.deck.inp.handlers import handles
from squeal.deck.inp.mesh import define
from squeal.deck.journal import Fault
from squeal.deck.mesh import EMPTY, Block
from squeal.deck.numbers import LONGEST, integer


def _optional(fields, at, line, default=1):
    return integer(fields[at], line) if len(fields) > at and fields[at] else default


@handles("NGEN", used=("NSET",), phase=0)
def generated_nodes(card, reader):
    """Rows of nodes between two others."""
    numbers = []
    for line, fields in card.rows():
        if not 2 <= len(fields) <= 3:
            raise Fault("a line has two nodes and a step; arcs are not supported", line=line)
        first, last = (reader.node_number(field, line) for field in fields[:2])
        step = _optional(fields, 2, line)
        if step < 1 or last <= first or (last - first) % step:
            raise Fault(f"{', '.join(fields)} is not a row of nodes", line=line)
        _require_short((last - first) // step, line)
        numbers.append(np.arange(first, last + 1, step))
        _fill(reader, numbers[-1])
    if numbers:
        define(card, reader, "NSET", reader.model.node_sets, np.concatenate(numbers))


def _require_short(count, line):
    if count > LONGEST:
        raise Fault(f"{count} members are more than {LONGEST}", line=line)


def _fill(reader, numbers):
    """Adds the nodes between the first and the last number, at equal distances."""
    ends = reader.scope.nodes.at([numbers[0], numbers[-1]])
    part = np.linspace(0, 1, len(numbers))[1:-1, None]
    reader.scope.nodes.add(numbers[1:-1], (1 - part) * ends[0] + part * ends[1])


@handles("NFILL", used=("NSET",), phase=0)
def filled_nodes(card, reader):
    """Rows of nodes between the nodes of two sets, in their order."""
    sets, found = reader.model.node_sets, []
    for line, fields in card.rows():
        if len(fields) < 3:
            raise Fault("a line has two node sets, and the numbers of intervals and of the step")
        first, last = (sets.members(reader.set_key(field, sets)) for field in fields[:2])
        count, step = integer(fields[2], line), _optional(fields, 3, line)
        if len(first) != len(last) or count < 1 or step < 1:
            raise Fault("the sets have different numbers of nodes, or there are no intervals")
        _require_short(count * len(first), line)
        for start, end in zip(first.tolist(), last.tolist()):
            numbers = start + step * np.arange(count + 1)
            row = reader.scope.node_numbers.made(np.append(numbers[:-1], end), line)
            _fill(reader, row)
            found.append(row)
    if found:
        define(card, reader, "NSET", sets, np.concatenate(found))


@handles(
    "NCOPY",
    used=("CHANGE NUMBER", "OLD SET", "NEW SET", "SHIFT", "MULTIPLE"),
    phase=0,
    lines=2,
)
def copied_nodes(card, reader):
    """Copies that are moved, and then turned, MULTIPLE times in sequence."""
    if "SHIFT" not in card.parameters:
        raise Fault("only copies by SHIFT are supported")
    if reader.scope.system is not None:
        raise Fault("copies within *SYSTEM are not supported")
    sets = reader.model.node_sets
    members = sets.members(reader.key(card, "OLD SET", sets))
    change = integer(card.require("CHANGE NUMBER"))
    count = integer(card.value("MULTIPLE") or "1")
    vector, matrix = position_of(card)
    if change == 0 or count < 1:
        raise Fault("the change of numbers is zero, or there are no copies")
    _require_short(count * len(members), None)
    places, copies = reader.scope.nodes.at(members), []
    for number in range(1, count + 1):
        places = places @ matrix.T + vector
        copies.append(reader.scope.node_numbers.made(members + number * change))
        reader.scope.nodes.add(copies[-1], places)
    define(card, reader, "NEW SET", sets, np.concatenate(copies))


@handles("ELGEN", used=("ELSET",), phase=0)
def generated_elements(card, reader):
    """Rows, layers and blocks of elements whose nodes have numbers with constant steps."""
    numbers = []
    for line, fields in card.rows():
        if len(fields) > 10 or len(fields) < 2:
            raise Fault("a line has an element, and up to three times three numbers", line=line)
        master = reader.scope.element_numbers.one(integer(fields[0], line), line)
        element_steps, node_steps = np.zeros(1, np.int64), np.zeros(1, np.int64)
        for at in range(1, len(fields), 3):
            count = _optional(fields, at, line)
            node, element = _optional(fields, at + 1, line), _optional(fields, at + 2, line)
            if count < 1:
                raise Fault(f"a row of {count} elements", line=line)
            _require_short(count * len(element_steps), line)
            row = np.arange(count)[:, None]
            element_steps = (element_steps + element * row).ravel()
            node_steps = (node_steps + node * row).ravel()
        block, row = _find(reader, master, line)
        new = reader.scope.element_numbers.made(element_steps[1:] + master, line)
        if len(new):
            nodes = block.nodes[row] + node_steps[1:, None]
            reader.model.blocks.append(Block(block.kind, block.shape, new, nodes, card.source))
        numbers += [np.array([master]), new]
    if numbers:
        define(card, reader, "ELSET", reader.model.element_sets, np.concatenate(numbers))


def _find(reader, number, line):
    for block in reversed(reader.model.blocks):
        rows = np.flatnonzero(block.numbers == number)
        if len(rows):
            return block, rows[0]
    raise Fault(f"there is no element {number} before this card", line=line)


@handles("ELCOPY", used=("ELEMENT SHIFT", "SHIFT NODES", "OLD SET", "NEW SET"), phase=0, lines=0)
def copied_elements(card, reader):
    sets = reader.model.element_sets
    members = sets.members(reader.key(card, "OLD SET", sets))
    shift, nodes = (integer(card.require(name)) for name in ("ELEMENT SHIFT", "SHIFT NODES"))
    copies, found = [], [EMPTY]
    for block in reader.model.blocks:
        on = np.isin(block.numbers, members)
        if np.any(on):
            found.append(block.numbers[on])
            table = block.nodes[on] + nodes
            copies.append(Block(block.kind, block.shape, found[-1] + shift, table, card.source))
    if shift == 0 or len(np.concatenate(found)) < len(members):
        raise Fault("ELEMENT SHIFT is zero, or elements of the set are not defined before")
    new = reader.scope.element_numbers.made(members + shift)
    reader.model.blocks += copies
    define(card, reader, "NEW SET", sets, new)
