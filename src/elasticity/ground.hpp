#pragma once
/// Springs and dashpots between node groups and the ground.
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "petsc/owned.hpp"

namespace squeal::elasticity {

/// Totals of all groups at each nodal displacement, N entries; empty if there are none.
struct Ground {
  OwnedVec springs;   ///< N/m
  OwnedVec dashpots;  ///< N·s/m
};

/// Collective. Each group's total is shared equally by its nodes. Error: fewer components than
/// dimensions.
Ground readGround(const mesh::Mesh& mesh);

}  // namespace squeal::elasticity
