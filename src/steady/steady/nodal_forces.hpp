// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Nodal forces of a steady state: N entries each, in newtons (moments on reference nodes in N·m).
#include "base/petsc/owned.hpp"
#include "eigen/sweep/parameters.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::steady {

/// Collective. Returns the loads b at this point.
OwnedVec loadAt(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                const sweep::Parameters& at);

/// Collective. Returns (K + v² K^R) u.
OwnedVec springForces(const mesh::Mesh& mesh, const elasticity::Bodies& bodies, double speed,
                      Vec displacement);

/// Collective. Returns r = (K + v² K^R) u − b, the nodal forces of supports and contact.
OwnedVec supportForces(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                       const sweep::Parameters& at, Vec displacement);

}  // namespace squeal::steady
