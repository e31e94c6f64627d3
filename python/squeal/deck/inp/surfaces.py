# SPDX-License-Identifier: BSD-2-Clause
"""Surfaces: faces of elements, or nodes."""
import numpy as np

from squeal.deck.inp.handlers import handles
from squeal.deck.journal import Fault
from squeal.deck.mesh import EMPTY, Surface
from squeal.deck.numbers import real

COMBINATIONS = ("UNION", "INTERSECTION", "DIFFERENCE")


@handles("SURFACE", used=("NAME", "TYPE", "COMBINE"), idle=("INTERNAL",), phase=1)
def surface(card, reader):
    key, name = reader.defined(card, "NAME")
    kind = card.key("TYPE", "ELEMENT")
    if key in reader.model.surfaces:
        raise Fault(f"surface '{name}' is defined twice")
    if kind not in ("ELEMENT", "NODE"):
        raise Fault(f"TYPE={kind} is not supported")
    if "COMBINE" in card.parameters:
        reader.model.surfaces[key] = _combined(card, reader, name)
    elif kind == "NODE":
        reader.model.surfaces[key] = _of_nodes(card, reader, name)
    else:
        rows = [_faces(fields, line, card, reader) for line, fields in card.rows()]
        elements, faces = np.concatenate([np.zeros((0, 2), np.int64), *rows]).T
        reader.model.surfaces[key] = Surface(name, card.source, None, elements, faces)


def _of_nodes(card, reader, name):
    """A line has a node or set, and the area of each node: 1 by default."""
    parts, areas = [EMPTY], set()
    for line, fields in card.rows():
        if len(fields) > 2:
            raise Fault("a line has a node or node set and an area", line=line)
        parts.append(reader.nodes_of(fields[0], line))
        areas.add(real(fields[1], line) if len(fields) == 2 and fields[1] else 1.0)
    if areas - {1.0}:
        reader.journal.remark(card.source, "the areas of the nodes are not used")
    numbers = np.unique(np.concatenate(parts))
    return Surface(name, card.source, nodes=numbers, areas_differ=len(areas) > 1)


def _faces(fields, line, card, reader):
    """Returns rows (element, face) of a line: an element or set and the label of a face; without
    the label all free faces."""
    elements = reader.elements_of(fields[0], line)
    if len(fields) == 2 and fields[1]:
        face = face_number(fields[1], "S", line)
        return np.column_stack([elements, np.full(len(elements), face, np.int64)])
    if len(fields) > 2:
        raise Fault("a line has an element or element set and the label of a face", line=line)
    rows = reader.free_faces(elements)
    reader.journal.remark(card.source, f"line {line}: {len(rows)} free faces")
    return rows


def _combined(card, reader, name):
    how = card.key("COMBINE")
    if how not in COMBINATIONS:
        raise Fault(f"COMBINE={how} is not supported", "COMBINE")
    parts = []
    for line, fields in card.rows():
        parts += [reader.model.surfaces[reader.surface_of(field, line)] for field in fields]
    if len(parts) < 2:
        raise Fault("a combination needs two surfaces")
    if any(part.nodes is not None for part in parts):
        raise Fault("a combination of surfaces needs faces")
    tables = [list(zip(part.elements.tolist(), part.faces.tolist())) for part in parts]
    first, rest = tables[0], tables[1:]
    if how == "UNION":
        rows = list(dict.fromkeys(row for table in tables for row in table))
    elif how == "INTERSECTION":
        common = set(first).intersection(*rest)
        rows = [row for row in first if row in common]
    else:
        without = {row for table in rest for row in table}
        rows = [row for row in first if row not in without]
    elements, faces = np.array(rows, np.int64).reshape(-1, 2).T
    return Surface(name, card.source, None, elements, faces)


def face_number(label, letter, line):
    """Returns the number of a face from 0, given its label, S3 or P3. Raises Fault."""
    label = label.upper()
    if len(label) != 2 or label[0] != letter or label[1] not in "123456":
        raise Fault(f"'{label}' is not a face: {letter}1 to {letter}6", line=line)
    return int(label[1]) - 1
