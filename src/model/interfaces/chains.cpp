// SPDX-License-Identifier: BSD-2-Clause
#include "model/interfaces/chains.hpp"

#include <algorithm>
#include <cmath>

#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"

namespace squeal::interfaces {
namespace {

/// A node that depends on masters, and its level; borrowed.
struct Follower {
  PetscInt node;                  // local
  std::vector<PetscInt> masters;  // global
  int* level;
};

/// The levels of the masters of this rank's followers, on any rank.
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
  /// Collective. Takes the levels of the owned followers; other nodes have the level 0.
  void set(const std::vector<Follower>& followers) {
    check(VecSet(all_, 0));
    {
      const WriteArray levels(all_);
      for (const auto& follower : followers) levels[follower.node] = *follower.level;
    }
    check(VecScatterBegin(scatter_, all_, found_, INSERT_VALUES, SCATTER_FORWARD));
    check(VecScatterEnd(scatter_, all_, found_, INSERT_VALUES, SCATTER_FORWARD));
  }
  /// Returns the largest level of the masters plus 1.
  int above(const Follower& follower) const {
    const ReadArray levels(found_);
    double largest = 0;
    for (const PetscInt master : follower.masters) {
      const auto at = std::lower_bound(masters_.begin(), masters_.end(), master);
      largest = std::max(largest, levels[at - masters_.begin()]);
    }
    return 1 + std::lround(largest);
  }

 private:
  std::vector<PetscInt> masters_;
  OwnedVec all_, found_;
  OwnedScatter scatter_;
};

/// Returns all nodes that depend on others.
std::vector<Follower> followersOf(const mesh::Mesh& mesh, Interfaces& all) {
  std::vector<Follower> followers;
  const auto add = [&](PetscInt node, const auto& masters, int& level) {
    followers.push_back({node, {}, &level});
    for (const auto& master : masters) followers.back().masters.push_back(master.node);
  };
  for (std::size_t k = 0; k < all.connections.size(); ++k) {
    auto& connection = all.connections[k];
    add(connection.node, connection.masters, connection.level);
    if (all.nodes[k].hasLayer())
      followers.back().masters.push_back(mesh.firstNode + all.nodes[k].surfaceNode);
  }
  for (auto& node : all.tied)
    add(node.connection.node, node.connection.masters, node.connection.level);
  for (auto& node : all.coupled) add(node.node, node.masters, node.level);
  return followers;
}

std::vector<PetscInt> mastersOf(const std::vector<Follower>& followers) {
  std::vector<PetscInt> masters;
  for (const auto& follower : followers)
    masters.insert(masters.end(), follower.masters.begin(), follower.masters.end());
  std::sort(masters.begin(), masters.end());
  masters.erase(std::unique(masters.begin(), masters.end()), masters.end());
  return masters;
}

/// Collective. Returns the labels of the interfaces and couplings with nodes of this level on any
/// rank.
std::string interfacesAt(const mesh::Mesh& mesh, const Interfaces& all, int level) {
  std::vector<int> found(all.options.size(), 0);
  for (std::size_t k = 0; k < all.nodes.size(); ++k)
    if (all.connections[k].level >= level) found[all.nodes[k].interface] = 1;
  for (const auto& node : all.tied)
    if (node.connection.level >= level) found[node.interface] = 1;
  std::vector<int> coupled(all.couplings.size(), 0);
  for (const auto& node : all.coupled)
    if (node.level >= level) coupled[node.coupling] = 1;
  mpi::reduce<int>(mesh.comm, found, MPI_MAX);
  mpi::reduce<int>(mesh.comm, coupled, MPI_MAX);
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (found[i]) labels.push_back(all.options[i].label());
  for (std::size_t i = 0; i < coupled.size(); ++i)
    if (coupled[i]) labels.push_back(all.couplings[i].label());
  return joined(labels);
}

}  // namespace

void setLevels(const mesh::Mesh& mesh, Interfaces& all) {
  const std::vector<Follower> followers = followersOf(mesh, all);
  MasterLevels masters(mesh, mastersOf(followers));
  // An acyclic chain passes each coupling at most once and each interface once or, with tied pairs
  // of nodes, twice.
  for (int pass = 0; pass <= 2 * std::ssize(all.options) + std::ssize(all.couplings); ++pass) {
    masters.set(followers);
    bool changed = false;
    all.levels = 1;
    for (const auto& follower : followers) {
      const int level = masters.above(follower);
      changed = changed || level != *follower.level;
      *follower.level = level;
      all.levels = std::max(all.levels, level);
    }
    changed = mpi::any(mesh.comm, changed);
    all.levels = mpi::max(mesh.comm, all.levels);
    if (!changed) return;
  }
  throw Error("the slaves of these interfaces depend on each other in a circle: " +
              interfacesAt(mesh, all, all.levels) +
              (all.couplings.empty() ? "; exchange slave and master of one interface"
                                     : "; exchange slave and master of one interface, or leave "
                                       "nodes out of a coupling"));
}

}  // namespace squeal::interfaces
