// SPDX-License-Identifier: BSD-2-Clause
#include "model/elasticity/ground.hpp"

#include <algorithm>

#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "model/elasticity/elasticity.hpp"

namespace squeal::elasticity {
namespace {

/// Collective. Distributes a total over the nodes of a group. Creates the vector if it is null and
/// the total is not zero.
void addShared(const mesh::Mesh& mesh, const std::string& group, const mesh::Point& total,
               OwnedVec& vector) {
  const auto& nodes = mesh.nodeGroups.at(group);
  const PetscInt count = mpi::sum(mesh.comm, PetscInt(nodes.size()));
  if (std::all_of(total.begin(), total.begin() + mesh.dimension, [](double x) { return x == 0; }))
    return;
  if (!vector) vector = nodalVector(mesh);
  const WriteArray values(vector);
  for (PetscInt node : nodes)
    for (int d = 0; d < mesh.dimension; ++d) values[mesh.dimension * node + d] += total[d] / count;
}

}  // namespace

Ground groundOf(const mesh::Mesh& mesh, const std::map<std::string, GroundSettings>& settings) {
  Ground ground;
  for (const auto& [group, given] : settings)
    if (given.springs) addShared(mesh, group, given.stiffness.in(mesh.dimension), ground.springs);
  for (const auto& [group, given] : settings)
    if (given.dashpots) addShared(mesh, group, given.damping.in(mesh.dimension), ground.dashpots);
  return ground;
}

}  // namespace squeal::elasticity
