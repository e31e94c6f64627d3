// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The boundary faces of all bodies: the faces that belong to exactly one cell.
#include <vector>

#include "model/mesh/mesh.hpp"

namespace squeal::elasticity {

/// A boundary face of the bodies; a line in plane problems.
struct BoundaryFace {
  int type = 0;                 ///< gmsh element type
  std::vector<PetscInt> nodes;  ///< local nodes, in gmsh's order
  int sign = 1;  ///< +1 if the normal by node order points out of the cell, −1 if into it
  int body = 0;  ///< of the cell, index into Mesh::bodies
};

/// Collective. Returns the boundary faces of the cells of this rank. Bodies in contact have
/// separate nodes, so the result includes faces in contact. Throws Error for a cell type without
/// known faces.
std::vector<BoundaryFace> boundaryFaces(const mesh::Mesh& mesh);

}  // namespace squeal::elasticity
