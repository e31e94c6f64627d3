# SPDX-License-Identifier: BSD-2-Clause
"""Writes the mesh of a case as a binary gmsh file, version 4.1.

Nodes and cells keep the numbers of the deck. Each entity of gmsh is a set of nodes, faces or cells
of one type that belong to the same groups: a member of several groups occurs only once, and gmsh
would lose cells of a second type.
"""
import struct

import numpy as np

from squeal.deck.case.groups import CELLS, FACES, NODES
from squeal.deck.cells import FACE_TYPES, POINT


def write_mesh(path, model, case, faces):
    """`faces`: looks up the nodes of faces. Raises OSError."""
    numbering = _numbers_of_groups(case)
    blocks = [*_points(case), *_faces(case, faces), *_cells(model, case)]
    with open(path, "wb") as file:
        file.write(b"$MeshFormat\n4.1 1 8\n" + struct.pack("<i", 1) + b"\n$EndMeshFormat\n")
        _write_names(file, numbering)
        entities = _write_entities(file, numbering, blocks, model)
        _write_nodes(file, model, case, entities)
        _write_elements(file, model, blocks)


def _numbers_of_groups(case):
    names = [(dimension, name) for dimension, groups in case.groups.items() for name in groups]
    return {key: number for number, key in enumerate(names, 1)}


def partition(groups):
    """Yields the names of groups, and the members that are in exactly these groups."""
    if not groups:
        return
    members = np.concatenate(list(groups.values()))
    unique, inverse = np.unique(members, axis=0, return_inverse=True)
    inverse = inverse.ravel()
    # Each group divides the parts that it meets. There may be a group for each node.
    part_of, names = np.zeros(len(unique), np.int64), [[]]
    at = 0
    for name, members in groups.items():
        rows = inverse[at : at + len(members)]
        at += len(members)
        before, which = np.unique(part_of[rows], return_inverse=True)
        part_of[rows] = len(names) + which.ravel()
        names += [[*names[one], name] for one in before]
    order = np.argsort(part_of, kind="stable")
    parts, first = np.unique(part_of[order], return_index=True)
    for part, chosen in zip(parts, np.split(order, first[1:])):
        yield names[part], unique[chosen]


def _points(case):
    for names, numbers in partition(case.groups[NODES]):
        yield NODES, names, (POINT, None, numbers[:, None])


def _faces(case, faces):
    for names, rows in partition(case.groups[FACES]):
        tables = [table for _, table in faces.tables(rows)]
        for size in sorted({table.shape[1] for table in tables}):
            table = np.concatenate([table for table in tables if table.shape[1] == size])
            yield FACES, names, (FACE_TYPES[size], None, table)


def _cells(model, case):
    for name, numbers in case.groups[CELLS].items():
        parts = {}
        for block in model.blocks:
            chosen = np.isin(block.numbers, numbers) if block.shape else np.zeros(0, bool)
            if np.any(chosen):
                nodes = block.nodes[chosen][:, block.shape.order]
                parts.setdefault(block.shape.gmsh, []).append((block.numbers[chosen], nodes))
        for kind, tables in parts.items():
            yield CELLS, [name], (kind, *map(np.concatenate, zip(*tables)))


def _write_names(file, numbering):
    lines = [f'{dimension} {number} "{name}"' for (dimension, name), number in numbering.items()]
    text = "\n".join(["$PhysicalNames", str(len(lines)), *lines, "$EndPhysicalNames\n"])
    file.write(text.encode("utf-8"))


def _write_entities(file, numbering, blocks, model):
    """Returns the numbers of the entities by block."""
    counts = [0, 0, 0, 0]
    entities, records = [], {dimension: [] for dimension in range(4)}
    for dimension, names, (_, _, nodes) in blocks:
        counts[dimension] += 1
        entities.append(counts[dimension])
        places = model.nodes.at(np.unique(nodes))
        low, high = places.min(axis=0), places.max(axis=0)
        box = struct.pack("<3d", *low) if dimension == 0 else struct.pack("<6d", *low, *high)
        tags = [numbering[dimension, name] for name in names]
        record = struct.pack("<i", counts[dimension]) + box
        record += struct.pack(f"<Q{len(tags)}i", len(tags), *tags)
        records[dimension].append(record + (struct.pack("<Q", 0) if dimension else b""))
    file.write(b"$Entities\n" + struct.pack("<4Q", *counts))
    for dimension in range(4):
        file.write(b"".join(records[dimension]))
    file.write(b"\n$EndEntities\n")
    return list(zip((block[0] for block in blocks), entities))


def _write_nodes(file, model, case, entities):
    numbers = case.nodes
    entity = next(number for dimension, number in entities if dimension == CELLS)
    file.write(b"$Nodes\n")
    file.write(struct.pack("<4Q", 1, len(numbers), int(numbers[0]), int(numbers[-1])))
    file.write(struct.pack("<3iQ", CELLS, entity, 0, len(numbers)))
    file.write(numbers.astype("<u8").tobytes())
    file.write(model.nodes.at(numbers).astype("<f8").tobytes())
    file.write(b"\n$EndNodes\n")


def _write_elements(file, model, blocks):
    """Cells keep their numbers; those of points and faces follow."""
    following = 1 + max(int(block.numbers.max()) for block in model.blocks if block.shape)
    first = following
    counts, chunks = {}, []
    total = 0
    lowest = min(int(part[1].min()) for _, _, part in blocks if part[1] is not None)
    for dimension, _, (kind, numbers, nodes) in blocks:
        counts[dimension] = counts.get(dimension, 0) + 1
        if numbers is None:
            numbers = np.arange(following, following + len(nodes))
            following += len(nodes)
        table = np.column_stack([numbers, nodes]).astype("<u8")
        chunks.append(struct.pack("<3iQ", dimension, counts[dimension], kind, len(nodes)))
        chunks.append(table.tobytes())
        total += len(nodes)
    highest = following - 1 if following > first else first - 1
    file.write(b"$Elements\n" + struct.pack("<4Q", len(blocks), total, lowest, highest))
    for chunk in chunks:
        file.write(chunk)
    file.write(b"\n$EndElements\n")
