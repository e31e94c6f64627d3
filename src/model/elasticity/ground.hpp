#pragma once
/// These functions read the springs and dashpots between node groups and the ground.
#include <string>
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::elasticity {

/// A Ground holds the sums over all groups at each nodal displacement, N entries. A vector is null
/// if all its values are zero.
struct Ground {
  OwnedVec springs;   ///< N/m
  OwnedVec dashpots;  ///< N·s/m
};

/// Collective. Returns the springs and dashpots that the options ask for. The total of each group
/// is shared equally by its nodes. Throws Error for fewer components than dimensions.
Ground readGround(const mesh::Mesh& mesh);

/// Not collective. Returns the groups with a `-ground_<group>_*` option.
std::vector<mesh::GroupRequest> groundedGroups();

}  // namespace squeal::elasticity
