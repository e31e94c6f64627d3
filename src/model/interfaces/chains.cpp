// SPDX-License-Identifier: BSD-2-Clause
#include "model/interfaces/chains.hpp"

#include <algorithm>
#include <cmath>

#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"

namespace squeal::interfaces {
namespace {

/// The levels of the masters of this rank's slaves, on any rank.
class MasterLevels {
 public:
  /// Collective. `masters` are global nodes, ascending, without repetition.
  MasterLevels(const mesh::Mesh& mesh, std::vector<PetscInt> masters)
      : masters_(std::move(masters)) {
    OwnedIS nodes;
    check(VecCreateMPI(mesh.comm, mesh.ownedNodes, PETSC_DETERMINE, all_.out()));
    check(VecCreateSeq(PETSC_COMM_SELF, masters_.size(), found_.out()));
    check(ISCreateGeneral(PETSC_COMM_SELF, masters_.size(), masters_.data(), PETSC_COPY_VALUES,
                          nodes.out()));
    check(VecScatterCreate(all_, nodes, found_, nullptr, scatter_.out()));
  }
  /// Collective. Takes the levels of the owned slaves; other nodes have the level 0.
  void set(const std::vector<Connection*>& slaves) {
    check(VecSet(all_, 0));
    {
      const WriteArray levels(all_);
      for (const auto* slave : slaves) levels[slave->node] = slave->level;
    }
    check(VecScatterBegin(scatter_, all_, found_, INSERT_VALUES, SCATTER_FORWARD));
    check(VecScatterEnd(scatter_, all_, found_, INSERT_VALUES, SCATTER_FORWARD));
  }
  /// Returns the largest level of the masters plus 1.
  int above(const Connection& slave) const {
    const ReadArray levels(found_);
    double largest = 0;
    for (const auto& master : slave.masters) {
      const auto at = std::lower_bound(masters_.begin(), masters_.end(), master.node);
      largest = std::max(largest, levels[at - masters_.begin()]);
    }
    return 1 + std::lround(largest);
  }

 private:
  std::vector<PetscInt> masters_;
  OwnedVec all_, found_;
  OwnedScatter scatter_;
};

std::vector<PetscInt> mastersOf(const std::vector<Connection*>& slaves) {
  std::vector<PetscInt> masters;
  for (const auto* slave : slaves)
    for (const auto& master : slave->masters) masters.push_back(master.node);
  std::sort(masters.begin(), masters.end());
  masters.erase(std::unique(masters.begin(), masters.end()), masters.end());
  return masters;
}

/// Collective. Returns the labels of the interfaces with nodes of this level on any rank.
std::string interfacesAt(const mesh::Mesh& mesh, const Interfaces& all, int level) {
  std::vector<int> found(all.options.size(), 0);
  for (std::size_t k = 0; k < all.nodes.size(); ++k)
    if (all.connections[k].level >= level) found[all.nodes[k].interface] = 1;
  for (const auto& node : all.tied)
    if (node.connection.level >= level) found[node.interface] = 1;
  mpi::reduce<int>(mesh.comm, found, MPI_MAX);
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i]) labels.push_back(all.options[i].label());
  return joined(labels);
}

}  // namespace

void setLevels(const mesh::Mesh& mesh, Interfaces& all) {
  std::vector<Connection*> slaves;
  for (auto& connection : all.connections) slaves.push_back(&connection);
  for (auto& node : all.tied) slaves.push_back(&node.connection);
  MasterLevels masters(mesh, mastersOf(slaves));
  // An acyclic chain passes each interface at most once or, with tied pairs of nodes, twice.
  for (int pass = 0; pass <= 2 * std::ssize(all.options); ++pass) {
    masters.set(slaves);
    bool changed = false;
    all.levels = 1;
    for (auto* slave : slaves) {
      const int level = masters.above(*slave);
      changed = changed || level != slave->level;
      slave->level = level;
      all.levels = std::max(all.levels, level);
    }
    changed = mpi::any(mesh.comm, changed);
    all.levels = mpi::max(mesh.comm, all.levels);
    if (!changed) return;
  }
  throw Error("the slaves of these interfaces depend on each other in a circle: " +
              interfacesAt(mesh, all, all.levels) + "; exchange slave and master of one interface");
}

}  // namespace squeal::interfaces
