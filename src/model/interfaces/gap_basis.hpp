// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The basis of the gaps on tri6 and quad8 faces. A uniform pressure on these faces has zero or
/// negative nodal forces at the corners, so the sign of a nodal force does not indicate
/// compression. The gaps g of the nodes are therefore combinations of other gaps h, on each edge e
/// between the corners a and b [M.12]:
///   g_a = h_a,   g_e = (1 − 2α) h_e + α (h_a + h_b),   g = E h,
///   φ̃_a = φ_a + α Σ φ_e,   φ̃_e = (1 − 2α) φ_e,
/// have positive integrals, and h ≥ 0 has g ≥ 0. The forces of h are Eᵀ times the nodal forces.
/// Source: A. Popp, B.I. Wohlmuth, M.W. Gee, W.A. Wall, *Dual quadratic mortar finite element
/// methods for 3D finite deformation contact*, SIAM J. Sci. Comput. 34 (2012) B421–B446.
#include <string>
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/coupling/coupling.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

/// The matrices of the change of basis. They act on the last component of nodal vectors, which
/// contains the gaps, and copy the other components.
struct GapBasis {
  OwnedMat matrix;   ///< E, N×N, with images replaced by their primaries; null if the identity
  OwnedMat inverse;  ///< E⁻¹, N×N; null if the identity

  explicit operator bool() const { return matrix.get() != nullptr; }
};

/// A contact node of an interface whose meshes do not match: its rows of E and of its inverse.
struct CombinedGap {
  PetscInt node;  ///< local node
  std::vector<coupling::Weight> row, inverse;
};

/// Collective. Returns E of the faces of the `surfaces`, and of the nodes with given rows. An edge
/// counts if its three nodes have a gap in the same interface, interfaceOf[local node]. `periodic`,
/// N×N, copies primaries to their images.
GapBasis gapBasis(const mesh::Mesh& mesh, const std::vector<std::string>& surfaces,
                  const std::vector<int>& interfaceOf, const std::vector<CombinedGap>& given,
                  Mat periodic);

}  // namespace squeal::interfaces
