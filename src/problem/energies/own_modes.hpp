// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The elastic modes of each body by itself: free in space, without supports, contact and
/// attachments.
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::energies {

/// Collective. Returns the owned nodes of each body, [body], ascending. A node that several bodies
/// share is listed for each of them. The cells of a body may be on any rank.
std::vector<std::vector<PetscInt>> nodesOfBodies(const mesh::Mesh& mesh);

/// The lowest elastic modes of one body.
struct OwnModes {
  std::vector<double> angularFrequency;  ///< ω, ascending, rad/s
  linalg::DenseMatrix vectors;  ///< (dimension · owned nodes of the body) × count, M-orthonormal
};

/// Collective. Takes the owned nodes of each body, [body]. Returns the `count` lowest elastic modes
/// of each body, [body], or all if it has fewer; an empty list if `count` is 0. They are the
/// eigenvectors x of
///   (K_b + σ M_b) x = (ω² + σ) M_b x,   σ = 0.01 wᵀ K_b w / wᵀ M_b w,   w = X − X_c,
/// where X are the coordinates of the nodes of the body and X_c is their mean. The shift σ is thus
/// 1 % of the Rayleigh quotient of a uniform stretch w. Modes with ω² ≤ 1e-6 σ are rigid and
/// omitted. A body without mass has no modes. Throws Error as modes::compute() does.
std::vector<OwnModes> ownModes(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                               const std::vector<std::vector<PetscInt>>& nodes, int count);

}  // namespace squeal::energies
