// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The geometric stiffness of a steady state.
#include "base/petsc/owned.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/mesh/mesh.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::steady {

/// Collective. Returns K_σ of the stress of the steady state [M.6], N×N; null unless
/// -elasticity_prestress adds it to the stiffness of vibrations.
OwnedMat prestressOf(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                     const Solution& solution);

}  // namespace squeal::steady
