# SPDX-License-Identifier: BSD-2-Clause
"""Solid cells: gmsh's types, the order of their nodes, and their faces.

The node order is that of Abaqus and CalculiX, with nodes counted from 0. Faces are in the order of
their labels S1, S2, …; their nodes go around as seen from outside, from the first node of CalculiX.
"""
from dataclasses import dataclass, field

HEXAHEDRON = ((3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
TETRAHEDRON = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))
WEDGE = ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5))
HEXAHEDRON_EDGES = (
    *((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4)),
    *((0, 4), (1, 5), (2, 6), (3, 7)),
)
TETRAHEDRON_EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
PYRAMID = ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))
PYRAMID_EDGES = ((0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4))
WEDGE_EDGES = ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5))
FACE_TYPES = {3: 2, 4: 3, 6: 9, 8: 16}  # gmsh's type of a face by its number of nodes
POINT = 15


@dataclass(frozen=True)
class Shape:
    """A cell: gmsh's number of its type, its number of nodes, the place in Abaqus' order of each
    node of gmsh's order, corner faces and edges with a node in the middle."""

    name: str
    gmsh: int
    size: int
    order: tuple
    corners: tuple
    edges: tuple = ()
    first_middle: int = 0
    faces: tuple = field(init=False)

    def __post_init__(self):
        middle = {
            frozenset(edge): self.first_middle + number for number, edge in enumerate(self.edges)
        }
        faces = []
        for face in self.corners:
            ends = zip(face, face[1:] + face[:1])
            faces.append(face + tuple(middle[frozenset(edge)] for edge in ends if middle))
        object.__setattr__(self, "faces", tuple(faces))


TET4 = Shape("tet4", 4, 4, tuple(range(4)), TETRAHEDRON)
TET10 = Shape("tet10", 11, 10, (*range(8), 9, 8), TETRAHEDRON, TETRAHEDRON_EDGES, 4)
HEX8 = Shape("hex8", 5, 8, tuple(range(8)), HEXAHEDRON)
HEX20_ORDER = (0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14)
HEX20 = Shape("hex20", 17, 20, HEX20_ORDER, HEXAHEDRON, HEXAHEDRON_EDGES, 8)
WEDGE6 = Shape("wedge6", 6, 6, tuple(range(6)), WEDGE)
WEDGE15_ORDER = (0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10)
WEDGE15 = Shape("wedge15", 18, 15, WEDGE15_ORDER, WEDGE, WEDGE_EDGES, 6)
PYRAMID5 = Shape("pyramid5", 7, 5, tuple(range(5)), PYRAMID)
PYRAMID13_ORDER = (0, 1, 2, 3, 4, 5, 8, 9, 6, 10, 7, 11, 12)
PYRAMID13 = Shape("pyramid13", 19, 13, PYRAMID13_ORDER, PYRAMID, PYRAMID_EDGES, 5)
