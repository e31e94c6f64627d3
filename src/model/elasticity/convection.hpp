// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Convective terms of moving bodies, in the axes of the vehicle and on Cartesian components [M.2]:
///   D u = (V·∇)u.
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/elasticity/motion.hpp"
#include "model/material/material.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::elasticity {

/// The matrices of the convective terms [4.10], N×N; null if no body moves.
struct ConvectiveTerms {
  OwnedMat gyroscopic;         ///< G, N·s/m
  OwnedMat rotationStiffness;  ///< K^R, N/m
};

/// Collective. Assembles the terms of these materials, [material group], and motions, [body].
/// Throws Error if the matter of a moving body crosses the surface of the body or of one of its
/// sections, since the place of the body, or the material at a place, would then change with time.
ConvectiveTerms convectiveTerms(const mesh::Mesh& mesh,
                                const std::vector<material::Material>& materials,
                                const std::vector<Motion>& motions);

}  // namespace squeal::elasticity
