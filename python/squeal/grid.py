# SPDX-License-Identifier: BSD-2-Clause
"""Meshes and modes as VTK grids."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import VTK_DOUBLE, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkUnstructuredGrid

# VTK's cell type of gmsh's element types and, where the order of the nodes differs, the node of
# gmsh for each of VTK: in solids gmsh sorts the mid-edge nodes by the corners of their edge, VTK
# walks round the base, round the top, then up the edges between.
CELLS = {
    2: (5, None),
    3: (9, None),
    4: (10, None),
    5: (12, None),
    6: (13, None),
    7: (14, None),
    9: (22, None),
    10: (28, None),
    11: (24, [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]),
    12: (
        29,
        [
            0,
            1,
            2,
            3,
            4,
            5,
            6,
            7,
            8,
            11,
            13,
            9,
            16,
            18,
            19,
            17,
            10,
            12,
            14,
            15,
            22,
            23,
            21,
            24,
            20,
            25,
            26,
        ],
    ),
    13: (32, [0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11, 15, 17, 16]),
    14: (27, [0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12]),
    16: (23, None),
    17: (25, [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15]),
    18: (26, [0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11]),
    19: (27, [0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12]),
}


def grid_of(mesh):
    """A vtkUnstructuredGrid with the cell array `body` and the names of the bodies as field
    data."""
    points = vtkPoints()
    points.SetData(numpy_to_vtk(mesh.coordinates, deep=True, array_type=VTK_DOUBLE))
    offsets, nodes, types, bodies = [np.zeros(1, np.int64)], [], [], []
    for gmsh_type, block in sorted(mesh.cells.items()):
        vtk_type, order = CELLS[gmsh_type]
        of_cells = block["nodes"] if order is None else block["nodes"][:, order]
        nodes.append(of_cells.astype(np.int64).ravel())
        offsets.append(
            offsets[-1][-1] + of_cells.shape[1] * np.arange(1, len(of_cells) + 1, dtype=np.int64)
        )
        types.append(np.full(len(of_cells), vtk_type, np.uint8))
        bodies.append(block["body"].ravel())
    cells = vtkCellArray()
    cells.SetData(
        numpy_to_vtkIdTypeArray(np.concatenate(offsets), deep=True),
        numpy_to_vtkIdTypeArray(np.concatenate(nodes), deep=True),
    )
    grid = vtkUnstructuredGrid()
    grid.SetPoints(points)
    grid.SetCells(numpy_to_vtk(np.concatenate(types), deep=True), cells)
    array = numpy_to_vtk(np.concatenate(bodies), deep=True)
    array.SetName("body")
    grid.GetCellData().AddArray(array)
    names = vtkStringArray()
    names.SetName("bodies")
    for name in mesh.bodies:
        names.InsertNextValue(name)
    grid.GetFieldData().AddArray(names)
    return grid


def add_points(grid, name, values):
    """Adds an array of the nodes to a grid."""
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    grid.GetPointData().AddArray(array)
