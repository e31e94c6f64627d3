// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Straightening of the edges of curved cells. Not collective: for rank 0 only.
#include "model/mesh/settings.hpp"
#include "model/mesh/whole.hpp"

namespace squeal::mesh {

/// Geometric functions of a cell, given its gmsh type and its nodes, m. model/elasticity provides
/// them, since model/mesh must not depend on model/elasticity.
struct CellGeometry {
  /// Returns true if the Jacobian is not positive at a quadrature point of the cell.
  bool (*isFolded)(int type, const std::vector<Point>& nodes);
  /// Returns the positions of the nodes with all edges straight.
  std::vector<Point> (*straightened)(int type, const std::vector<Point>& nodes);
};

/// Straightens none of the cells, the folded ones, or all, by moving their nodes other than corners
/// to the positions that `geometry` gives. These moves also change neighbouring cells that share
/// the nodes. Periodic images and primaries move together, and so do partners in contact;
/// WholeMesh::images and pairs must already be filled. If a move folds another cell, that cell is
/// straightened in a further round. Fills WholeMesh::straightened.
void straighten(WholeMesh& mesh, const CellGeometry& geometry, Straightening which);

}  // namespace squeal::mesh
