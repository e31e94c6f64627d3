#include "model/elasticity/ground.hpp"

#include <algorithm>
#include <map>

#include "base/options/options.hpp"
#include "base/petsc/arrays.hpp"
#include "model/elasticity/elasticity.hpp"

namespace squeal::elasticity {
namespace {

const RealListOption stiffnessOption("constraint", "ground_<group>_stiffness", "0,0,0", "N/m",
                                     nonNegative,
                                     "springs along x, y, z to the ground, total of the group, "
                                     "shared equally by its nodes (per m of depth in the plane)");
const RealListOption dampingOption("constraint", "ground_<group>_damping", "0,0,0", "N s/m",
                                   nonNegative, "dashpots to the ground, shared in the same way");

/// Returns the values of all groups shared by their nodes, N entries; null if all are zero.
OwnedVec shared(const mesh::Mesh& mesh, const RealListOption& option) {
  OwnedVec vector;
  for (const auto& group : option.subjects()) {
    const auto total = option.components(group, mesh.dimension);
    const auto& nodes = mesh.nodeGroups.at(group);
    PetscInt count = nodes.size();
    check(MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPIU_INT, MPI_SUM, mesh.comm));
    if (std::all_of(total.begin(), total.begin() + mesh.dimension, [](double x) { return x == 0; }))
      continue;
    if (!vector) vector = nodalVector(mesh);
    const WriteArray values(vector);
    for (PetscInt node : nodes)
      for (int d = 0; d < mesh.dimension; ++d)
        values[mesh.dimension * node + d] += total[d] / count;
  }
  return vector;
}

}  // namespace

std::vector<mesh::GroupRequest> groundedGroups() {
  std::map<std::string, std::string> options;
  for (const auto* option : {&stiffnessOption, &dampingOption})
    for (const auto& group : option->subjects())
      options.emplace(group, "-" + option->fullName(group));
  std::vector<mesh::GroupRequest> requests;
  for (const auto& [group, option] : options) requests.push_back({group, option});
  return requests;
}

Ground readGround(const mesh::Mesh& mesh) {
  return {shared(mesh, stiffnessOption), shared(mesh, dampingOption)};
}

}  // namespace squeal::elasticity
