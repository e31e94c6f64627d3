// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The matrices of sliding at the contact nodes.
#include "base/petsc/owned.hpp"
#include "model/contact/kinematics.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::contact {

/// The matrices of sliding, N×N. Rows that are not mentioned are empty.
struct Sliding {
  OwnedMat reaction;   ///< N: maps nodal forces to R_N, in the rows of the gaps
  OwnedMat jump;       ///< J: maps u to [u] = u_P − u_D, in the rows of the contact nodes
  OwnedMat convected;  ///< D, 1/s: maps u to (V·∇)u_D, in the rows of the contact nodes, at the
                       ///< speed factor 1; null without convective terms
};

/// Input of slidingOf(), all borrowed.
struct SlidingInput {
  const mesh::Mesh& mesh;
  const elasticity::Bodies& bodies;
  const interfaces::Interfaces& interfaces;
  const Kinematics& kinematics;
  Mat periodic;  ///< P
};

/// Collective. Returns the matrices of sliding.
Sliding slidingOf(const SlidingInput& input);

}  // namespace squeal::contact
