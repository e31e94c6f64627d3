// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Straightening of the edges of curved cells. Not collective: for rank 0 only.
#include "model/mesh/settings.hpp"
#include "model/mesh/whole.hpp"

namespace squeal::mesh {

/// Functions of a cell, given its gmsh type and its nodes, m. They belong to its elements, which
/// the mesh does not know.
struct CellGeometry {
  /// Returns true if the Jacobian is not positive at a point where the cell is integrated.
  bool (*isFolded)(int type, const std::vector<Point>& nodes);
  /// Returns the places of the nodes with all edges straight.
  std::vector<Point> (*straightened)(int type, const std::vector<Point>& nodes);
};

/// Straightens none of the cells, those that are folded, or all. It moves their nodes other than
/// corners to the places that `geometry` gives. Cells that share these nodes follow, and so do
/// images, primaries and partners in contact, which are moved alike; images and pairs must be
/// known. A cell that this folds is straightened in another round. Fills WholeMesh::straightened.
void straighten(WholeMesh& mesh, const CellGeometry& geometry, Straightening which);

}  // namespace squeal::mesh
