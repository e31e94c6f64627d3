// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Springs and dashpots between node groups and the ground.
#include <map>
#include <string>

#include "base/petsc/owned.hpp"
#include "model/elasticity/settings.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::elasticity {

/// The sums over all groups at each nodal displacement, N entries. A vector is null if all its
/// values are zero.
struct Ground {
  OwnedVec springs;   ///< N/m
  OwnedVec dashpots;  ///< N·s/m
};

/// Collective. Returns the springs and dashpots. The nodes of each group share its total equally.
/// Throws Error for fewer components than dimensions.
Ground groundOf(const mesh::Mesh& mesh, const std::map<std::string, GroundSettings>& settings);

}  // namespace squeal::elasticity
