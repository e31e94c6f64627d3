# SPDX-License-Identifier: BSD-2-Clause
"""The surface of a mesh, for the report."""
import math

import numpy as np
from scipy.spatial import cKDTree
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkFiltersCore import (
    vtkFeatureEdges,
    vtkQuadricClustering,
    vtkThreshold,
    vtkTriangleFilter,
)
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter

from squeal.grid import add_points, grid_of

MOST_TRIANGLES = 200_000  # which a processor without a graphics card still draws


class Skin:
    """The boundary of the bodies: triangles on corner nodes, with separate nodes for each body.
    A boundary of more than MOST_TRIANGLES is coarsened."""

    def __init__(self, mesh):
        grid = grid_of(mesh)
        add_points(grid, "node", np.arange(len(mesh.coordinates), dtype=np.int64))
        surfaces = {name: _surface_of(grid, number) for number, name in enumerate(mesh.bodies)}
        surfaces = {
            name: surface for name, surface in surfaces.items() if surface.GetNumberOfPolys()
        }
        self.whole = sum(surface.GetNumberOfPolys() for surface in surfaces.values())
        self.detail = 0.0  # m; smaller details are not drawn
        if self.whole > MOST_TRIANGLES:
            surfaces, self.detail = _coarser(surfaces)
        # Bodies smaller than that detail.
        self.unseen = [name for name, surface in surfaces.items() if not surface.GetNumberOfPolys()]
        self.nodes, self.triangles, self.lines, self.bodies = [], [], [], []
        first, triangles, lines = 0, 0, 0
        for name, surface in surfaces.items():
            if name in self.unseen:
                continue
            nodes = _nodes(surface)
            faces = _cells(surface.GetPolys(), 3)
            sides = _sides(surface, nodes)
            self.nodes.append(nodes)
            self.triangles.append(first + faces)
            self.lines.append(first + sides)
            self.bodies.append(
                {
                    "name": name,
                    "nodes": [first, first + len(nodes)],
                    "triangles": [triangles, triangles + len(faces)],
                    "lines": [lines, lines + len(sides)],
                }
            )
            first, triangles, lines = first + len(nodes), triangles + len(faces), lines + len(sides)
        self.nodes, self.triangles, self.lines = (
            np.concatenate(part) for part in (self.nodes, self.triangles, self.lines)
        )


def _surface_of(grid, body):
    chosen = vtkThreshold()
    chosen.SetInputData(grid)
    chosen.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, "body")
    chosen.SetLowerThreshold(body - 0.5)
    chosen.SetUpperThreshold(body + 0.5)
    outside = vtkDataSetSurfaceFilter()
    outside.SetInputConnection(chosen.GetOutputPort())
    outside.SetNonlinearSubdivisionLevel(0)
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(outside.GetOutputPort())
    triangles.PassLinesOff()
    triangles.PassVertsOff()
    triangles.Update()
    return triangles.GetOutput()


def _coarser(surfaces):
    """Returns surfaces with one node for each cube of space that they pass through, and the side
    of the cubes. Flat faces keep nodes, since modes bend them."""
    area = sum(
        np.linalg.norm(np.cross(*_edges_of(surface)), axis=1).sum() / 2
        for surface in surfaces.values()
    )
    side = math.sqrt(2 * area / MOST_TRIANGLES)
    while True:
        coarse = {name: _clustered(surface, side) for name, surface in surfaces.items()}
        count = sum(surface.GetNumberOfPolys() for surface in coarse.values())
        if count <= MOST_TRIANGLES:
            return coarse, side
        side *= max(1.05, math.sqrt(count / MOST_TRIANGLES))


def _edges_of(surface):
    """Two edges of each triangle."""
    a, b, c = (_places(surface)[corner] for corner in _cells(surface.GetPolys(), 3).T)
    return b - a, c - a


def _clustered(surface, side):
    cubes = vtkQuadricClustering()
    cubes.SetInputData(surface)
    cubes.AutoAdjustNumberOfDivisionsOff()
    cubes.SetDivisionOrigin(0, 0, 0)
    cubes.SetDivisionSpacing(side, side, side)
    cubes.UseInputPointsOn()
    cubes.Update()
    coarse = cubes.GetOutput()
    # The filter keeps points but not their arrays.
    _, nearest = cKDTree(_places(surface)).query(_places(coarse))
    add_points(coarse, "node", _nodes(surface)[nearest])
    return coarse


def _places(surface):
    return vtk_to_numpy(surface.GetPoints().GetData()).astype(float)


def _nodes(surface):
    return vtk_to_numpy(surface.GetPointData().GetArray("node"))


def _sides(surface, nodes):
    """The edges of the body, as pairs of places in `nodes`."""
    edges = vtkFeatureEdges()
    edges.SetInputData(surface)
    edges.SetFeatureAngle(30)
    edges.ColoringOff()
    edges.NonManifoldEdgesOff()
    edges.Update()
    found = edges.GetOutput()
    if not found.GetNumberOfLines():
        return np.zeros((0, 2), np.int64)
    order = np.argsort(nodes)
    return order[np.searchsorted(nodes, _nodes(found), sorter=order)][_cells(found.GetLines(), 2)]


def _cells(array, corners):
    return vtk_to_numpy(array.GetConnectivityArray()).reshape(-1, corners).astype(np.int64)


__all__ = ["Skin"]
