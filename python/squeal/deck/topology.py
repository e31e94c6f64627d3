# SPDX-License-Identifier: BSD-2-Clause
"""Faces of cells that are the same because they have the same corners."""
import numpy as np


def corners_of(size):
    """Returns the number of corners of a face with so many nodes."""
    return 3 if size in (3, 6) else 4


def hashes(corners):
    """Returns a number for each row that does not depend on the order of its entries."""
    mixed = corners.astype(np.uint64) * np.uint64(0x9E3779B97F4A7C15)
    mixed ^= mixed >> np.uint64(29)
    return (mixed * np.uint64(0xBF58476D1CE4E5B9)).sum(axis=1, dtype=np.uint64)


def free_faces(model):
    """Returns the faces of solid cells that no other cell has, as rows (element, face from 0) in
    the order of their element numbers. To be called when the blocks are merged."""
    found = [np.zeros(0, np.uint64)]
    rows = [np.zeros((0, 2), np.int64)]
    for block in model.blocks:
        for number, face in enumerate(block.shape.faces if block.shape else ()):
            found.append(hashes(block.nodes[:, face[: corners_of(len(face))]]))
            rows.append(np.column_stack([block.numbers, np.full(len(block.numbers), number)]))
    _, first, counts = np.unique(np.concatenate(found), return_index=True, return_counts=True)
    free = np.concatenate(rows)[first[counts == 1]]
    return free[np.lexsort((free[:, 1], free[:, 0]))]
