// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The basis of the gaps on tri6 and quad8 faces. A uniform pressure on these faces has nodal
/// forces that are zero or negative at the corners, so that the sign of a nodal force does not tell
/// whether the contact is pressed. The gaps g of the nodes are therefore combined from others, h,
/// on each edge e between the corners a and b [M.12]:
///   g_a = h_a,   g_e = (1 − 2α) h_e + α (h_a + h_b),   g = E h,
/// with the α of mortar::usualAlpha().
/// The shape functions of h,
///   φ̃_a = φ_a + α Σ φ_e,   φ̃_e = (1 − 2α) φ_e,
/// have positive integrals, and h ≥ 0 has g ≥ 0. The forces that belong to h are Eᵀ times the nodal
/// forces. Source: A. Popp, B.I. Wohlmuth, M.W. Gee, W.A. Wall, *Dual quadratic mortar finite
/// element methods for 3D finite deformation contact*, SIAM J. Sci. Comput. 34 (2012) B421–B446.
#include <string>
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/coupling/coupling.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

/// The matrices of the change of basis. They act on nodal vectors whose component of the gap, the
/// last one, holds a value per node. The other components are copied.
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

/// Collective. Returns E of the faces of the `surfaces`, and of the nodes whose rows are given. An
/// edge counts if its three nodes have a gap in one interface, interfaceOf[local node].
/// `periodic` copies primaries to their images, N×N.
GapBasis gapBasis(const mesh::Mesh& mesh, const std::vector<std::string>& surfaces,
                  const std::vector<int>& interfaceOf, const std::vector<CombinedGap>& given,
                  Mat periodic);

}  // namespace squeal::interfaces
