// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The basis of the gaps on faces with six or eight nodes (tri6, quad8). A uniform pressure on
/// these faces causes zero or negative nodal forces at the corners, so the sign of a nodal force
/// does not show whether there is pressure at the node. Therefore the unknowns are not the gaps g
/// but coefficients h. Let a and b be the corners of an edge, and e its middle node. With a weight
/// α, usually 1/5, the gaps are [M.12]
///   g_a = h_a,   g_e = (1 − 2α) h_e + α (h_a + h_b),   in short g = E h.
/// The shape functions of h follow from those of g, φ:
///   φ̃_a = φ_a + α Σ φ_e,   φ̃_e = (1 − 2α) φ_e.
/// Their integrals are positive, so that normal forces have the sign of the pressure. If h ≥ 0,
/// then g ≥ 0. The forces that do work on h are Eᵀ times the nodal forces. Source: A. Popp, B.I.
/// Wohlmuth, M.W. Gee, W.A. Wall, *Dual quadratic mortar finite element methods for 3D finite
/// deformation contact*, SIAM J. Sci. Comput. 34 (2012) B421–B446.
#include <string>
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/coupling/coupling.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

/// The matrices of the change of basis. They act on the last component of each node, which contains
/// the gap, and copy the other components. The gap of a periodic image is that of its primary node.
struct GapBasis {
  OwnedMat matrix;   ///< E, N×N; null if the identity
  OwnedMat inverse;  ///< E⁻¹, N×N; null if the identity

  explicit operator bool() const { return matrix.get() != nullptr; }
};

/// A contact node of an interface whose meshes do not match, with its rows of E and E⁻¹.
struct CombinedGap {
  PetscInt node;  ///< local node
  std::vector<coupling::Weight> row, inverse;
};

/// Collective. Returns E and E⁻¹. They act on the edges of the faces of `surfaces` whose three
/// nodes have a gap in the same interface (interfaceOf[local node]), and on the nodes with `given`
/// rows. `periodic`, N×N, copies the displacement of each primary node to its periodic image.
GapBasis gapBasis(const mesh::Mesh& mesh, const std::vector<std::string>& surfaces,
                  const std::vector<int>& interfaceOf, const std::vector<CombinedGap>& given,
                  Mat periodic);

}  // namespace squeal::interfaces
