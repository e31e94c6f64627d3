// SPDX-License-Identifier: BSD-2-Clause
#include "model/elasticity/ground.hpp"

#include <algorithm>
#include <map>

#include "base/petsc/check.hpp"
#include "base/system/error.hpp"
#include "base/system/mpi.hpp"
#include "model/elasticity/assembly.hpp"
#include "model/frame/frame.hpp"

namespace squeal::elasticity {
namespace {

using mesh::Matrix3;

/// Returns Σ_k v_k a_k a_kᵀ.
Matrix3 alongAxes(const mesh::Point& values, const Matrix3& axes) {
  Matrix3 sum{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) sum[i][j] += axes[k][i] * values[k] * axes[k][j];
  return sum;
}

/// Collective. Returns the share of each node of the group in a total along the axes of its frame.
std::vector<Matrix3> shares(const mesh::Mesh& mesh, const Settings& settings,
                            const std::string& group, const VectorValue& given) {
  const auto& nodes = mesh.nodeGroups.at(group);
  const PetscInt count = mpi::sum(mesh.comm, PetscInt(nodes.size()));
  const auto frame = frame::named(settings.attachments.frames, settings.ground.at(group).frame,
                                  groundFrameName(group), mesh);
  mesh::Point total = given.in(mesh.dimension);
  for (double& x : total) x /= count;
  std::vector<Matrix3> result;
  std::string failure;
  for (const PetscInt node : nodes) try {
      result.push_back(alongAxes(total, frame.axesAt(mesh.coordinates[node])));
    } catch (const Error& error) {
      failure = error.what();
    }
  failTogether(mesh.comm, failure);
  return result;
}

using Blocks = std::map<PetscInt, Matrix3>;  // [local node]

void add(const mesh::Mesh& mesh, const std::string& group, const std::vector<Matrix3>& shares,
         Blocks& blocks) {
  const auto& nodes = mesh.nodeGroups.at(group);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    Matrix3& block = blocks[nodes[n]];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) block[i][j] += shares[n][i][j];
  }
}

/// Collective. Returns the matrix with these blocks, with all entries of the diagonal; null if all
/// blocks are zero.
OwnedMat toMatrix(const mesh::Mesh& mesh, const Blocks& blocks) {
  const int dimension = mesh.dimension;
  Triples triples;
  bool any = false;
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node) {
    const auto block = blocks.find(node);
    const PetscInt row = dimension * (mesh.firstNode + node);
    for (int i = 0; i < dimension; ++i)
      for (int j = 0; j < dimension; ++j) {
        const double value = block == blocks.end() ? 0 : block->second[i][j];
        if (value != 0 || i == j) triples.add(row + i, row + j, value);
        any = any || value != 0;
      }
  }
  if (!mpi::any(mesh.comm, any)) return {};
  return elasticity::toMatrix(mesh, triples, SymmetryClass::symmetric);
}

}  // namespace

std::vector<Matrix3> groundSprings(const mesh::Mesh& mesh, const Settings& settings,
                                   const std::string& group) {
  const auto& given = settings.ground.at(group);
  return given.springs ? shares(mesh, settings, group, given.stiffness) : std::vector<Matrix3>();
}

std::vector<Matrix3> groundDashpots(const mesh::Mesh& mesh, const Settings& settings,
                                    const std::string& group) {
  const auto& given = settings.ground.at(group);
  return given.dashpots ? shares(mesh, settings, group, given.damping) : std::vector<Matrix3>();
}

Ground groundOf(const mesh::Mesh& mesh, const Settings& settings) {
  Ground ground;
  Blocks springs, dashpots;
  for (const auto& [group, given] : settings.ground) {
    if (given.springs) add(mesh, group, groundSprings(mesh, settings, group), springs);
    if (!given.dashpots) continue;
    add(mesh, group, groundDashpots(mesh, settings, group), dashpots);
    if (!given.frame.empty()) ground.turnedDashpots = true;
  }
  ground.springs = toMatrix(mesh, springs);
  ground.dashpots = toMatrix(mesh, dashpots);
  return ground;
}

}  // namespace squeal::elasticity
