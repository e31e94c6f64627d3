// SPDX-License-Identifier: BSD-2-Clause
#include "steady/steady/condition_forces.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/interfaces/algebra.hpp"
#include "model/interfaces/dependence.hpp"

namespace squeal::steady {

Conditions::Conditions(const contact::Contact& contact)
    : contact_(contact),
      all_(contact.interfaces),
      mesh_(*contact.mesh),
      levels_(interfaces::levelsOfFollowers(mesh_, all_)),
      isTurned_(mesh_.ownedNodes, 0) {
  for (int level = 1; level <= all_.levels; ++level) {
    const bool any = mpi::any(mesh_.comm, std::ranges::count(levels_, level) > 0);
    rows_.push_back(any ? interfaces::rowsOfLevel(mesh_, all_, level) : OwnedMat());
  }
  if (mpi::any(mesh_.comm, !all_.tied.empty())) findPlaces();
  for (const auto& [node, axes] : all_.constraints.axes) isTurned_[node] = levels_[node] == 0;
  for (const auto& node : all_.nodes) isTurned_[node.node] = 0;
}

/// Collective. Finds the points of the masters at which the tied nodes are.
void Conditions::findPlaces() {
  const int dimension = mesh_.dimension;
  std::vector<PetscInt> blocks(mesh_.ownedNodes, 1);
  for (const auto& tied : all_.tied) blocks[tied.connection.node] += tied.connection.masters.size();
  const OwnedMat weights = interfaces::nodalMatrix(mesh_, blocks);
  for (const auto& tied : all_.tied)
    for (const auto& [master, weight] : tied.connection.masters)
      interfaces::setBlock(weights, dimension, mesh_.firstNode + tied.connection.node, master,
                           interfaces::identity(dimension, weight));
  interfaces::assembled(weights);
  const OwnedVec positions = elasticity::nodalVector(mesh_), means = elasticity::nodalVector(mesh_);
  {
    const WriteArray values(positions);
    for (PetscInt node = 0; node < mesh_.ownedNodes; ++node)
      std::copy_n(mesh_.coordinates[node].begin(), dimension, values.begin() + dimension * node);
  }
  check(MatMult(weights, positions, means));
  const ReadArray values(means);
  for (const auto& tied : all_.tied)
    places_.push_back(componentsAt(mesh_, values.data(), tied.connection.node));
}

void Conditions::addPeriodicity(const double* forces, ConditionForces& found) const {
  //   x_image × f − x_primary × f
  for (const auto& image : mesh_.images) {
    const Point moment = mesh::cross(image.shift, componentsAt(mesh_, forces, image.node));
    found.periodicity.moment = mesh::plus(found.periodicity.moment, moment);
  }
}

void Conditions::addTies(int level, const double* forces, ConditionForces& found) const {
  for (std::size_t i = 0; i < all_.tied.size(); ++i) {
    const auto& tied = all_.tied[i];
    if (tied.connection.level != level) continue;
    Point force = componentsAt(mesh_, forces, tied.connection.node);
    for (std::size_t d = 0; d < 3; ++d)
      if (tied.apart[d]) force[d] = 0;
    double share = 0;
    for (const auto& [master, weight] : tied.connection.masters) share += weight;
    found.slaves[tied.interface].addNode(mesh_, tied.connection.node, force);
    Wrench& sum = found.masters[tied.interface];
    sum.force = mesh::plus(sum.force, force, -share);
    sum.moment = mesh::plus(sum.moment, mesh::cross(places_[i], force), -1);
  }
}

/// Adds a force of a coupling on a node if it belongs to a reference node.
void Conditions::addOnReference(PetscInt global, const Point& value, ConditionForces& found) const {
  const mesh::Reference* reference = mesh_.referenceWith(global);
  if (!reference) return;
  Wrench& sum = found.references[reference - mesh_.references.data()];
  if (global == reference->rotation)
    sum.addMoment(value, mesh_.dimension);
  else
    sum.addForce(reference->position, value);
}

void Conditions::addCouplings(int level, const double* forces, ConditionForces& found) const {
  const std::size_t n = mesh_.dimension;
  for (const auto& coupled : all_.coupled) {
    if (coupled.level != level) continue;
    const Point whole = componentsAt(mesh_, forces, coupled.node);
    if (const int bolt = coupled.coupling - std::ssize(found.couplings); bolt >= 0) {
      found.bolts[bolt].addNode(mesh_, coupled.node, whole);
      continue;
    }
    // The coupling exerts no force along the components that stay free.
    Point force = whole;
    for (std::size_t k = 0; k < n; ++k) {
      const Point axis{coupled.own[0][k], coupled.own[1][k], coupled.own[2][k]};
      if (coupled.free[k]) force = mesh::plus(force, axis, -mesh::dot(axis, whole));
    }
    Wrench& sum = found.couplings[coupled.coupling];
    if (coupled.distributed) sum.addNode(mesh_, coupled.node, force);
    addOnReference(mesh_.firstNode + coupled.node, force, found);
    for (const auto& master : coupled.masters) {
      Point onMaster{};
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) onMaster[j] -= master.block[i][j] * whole[i];
      addOnReference(master.node, onMaster, found);
      if (coupled.distributed) continue;
      if (master.isRotation)
        sum.addMoment(onMaster, mesh_.dimension);
      else
        sum.addForce(master.position, onMaster);
    }
  }
}

/// Collective. Moves the forces of all followers to the nodes that they depend on, in `forces`, and
/// adds the forces of the conditions to `found` unless it is null.
void Conditions::transfer(Vec forces, ConditionForces* found) const {
  const OwnedVec moved = elasticity::nodalVector(mesh_);
  if (found) addPeriodicity(ReadArray(forces).data(), *found);
  check(MatMultTranspose(contact_.periodic, forces, moved));
  check(VecCopy(moved, forces));
  for (int level = all_.levels; level > 0; --level) {
    if (!rows_[level - 1]) continue;
    if (found) {
      const ReadArray values(forces);
      addTies(level, values.data(), *found);
      addCouplings(level, values.data(), *found);
    }
    check(MatMultTranspose(rows_[level - 1], forces, moved));
    check(VecCopy(moved, forces));
  }
}

/// Collective. Returns the factors λ on the weights of the equations, [Constraints::origins], from
/// the forces on components that depend on no others except by equations.
std::vector<double> Conditions::multipliers(Vec forces) const {
  const auto& constraints = all_.constraints;
  std::vector<double> found(constraints.origins.size(), 0.0);
  const ReadArray values(forces);
  for (const auto& pivot : constraints.pivots) {
    const PetscInt node = pivot.row / mesh_.dimension;
    const double force = isTurned_[node]
                             ? mesh::dot(constraints.direction(node, pivot.row % mesh_.dimension),
                                         componentsAt(mesh_, values.data(), node))
                             : values[pivot.row];
    for (const auto& [origin, factor] : pivot.origins) found[origin] += factor * force;
  }
  mpi::reduce<double>(mesh_.comm, found, MPI_SUM);
  return found;
}

/// Adds the force of all supports of a node. It lies in the span of their directions.
void Conditions::addSupport(PetscInt node, const Point& force, ConditionForces& found) const {
  const auto& constraints = all_.constraints;
  const auto given = constraints.given.find(node);
  if (given == constraints.given.end()) {
    for (int d = 0; d < mesh_.dimension; ++d) {
      const int group = constraints.heldBy[mesh_.dimension * node + d];
      Point part{};
      part[d] = force[d];
      if (group >= 0) found.supports[group].addNode(mesh_, node, part);
    }
    return;
  }
  //   Σ_j (d_i·d_j) λ_j = d_i·force
  const auto& directions = given->second;
  mesh::Matrix3 gram = mesh::identity3;
  for (std::size_t i = 0; i < directions.size(); ++i)
    for (std::size_t j = 0; j < directions.size(); ++j)
      gram[i][j] = mesh::dot(directions[i].direction, directions[j].direction);
  const mesh::Matrix3 inverse = mesh::inverse(gram, mesh::determinant(gram));
  for (std::size_t j = 0; j < directions.size(); ++j) {
    double factor = 0;
    for (std::size_t i = 0; i < directions.size(); ++i)
      factor += inverse[j][i] * mesh::dot(directions[i].direction, force);
    found.supports[directions[j].group].addNode(mesh_, node, directions[j].direction, factor);
  }
}

/// Subtracts the forces of the equations from `forces`, and adds them to `found`.
void Conditions::takeEquations(const std::vector<double>& multipliers, Vec forces,
                               ConditionForces& found) const {
  const auto& constraints = all_.constraints;
  const WriteArray values(forces);
  const auto take = [&](PetscInt node, const Point& force) {
    for (int d = 0; d < mesh_.dimension; ++d) values[mesh_.dimension * node + d] -= force[d];
  };
  std::map<PetscInt, Point> onFollowers;  // [owned node] force of its supports
  for (std::size_t i = 0; i < multipliers.size(); ++i) {
    const auto& origin = constraints.origins[i];
    if (origin.group >= 0) {
      const PetscInt node = mesh_.ownedNode(origin.node);
      if (node < 0) continue;
      Point& sum = onFollowers[node];
      sum = mesh::plus(sum, origin.direction, multipliers[i]);
      continue;
    }
    for (const auto& term : constraints.equations[origin.option].terms) {
      const PetscInt node = constraints::nodeOf(mesh_, term);
      if (node < 0) continue;
      Point force{};
      force[mesh_.dimension == 2 && term.rotation ? 0 : term.component] =
          multipliers[i] * term.factor;
      take(node, force);
      found.equations[origin.option].addNode(mesh_, node, force);
    }
  }
  for (const auto& [node, force] : onFollowers) {
    take(node, force);
    addSupport(node, force, found);
  }
}

/// Adds the forces of the supports that hold components directly.
void Conditions::addSupports(Vec forces, ConditionForces& found) const {
  const auto& constraints = all_.constraints;
  std::vector<std::array<unsigned char, 3>> holds(mesh_.ownedNodes, {1, 1, 1});
  for (const auto& coupled : all_.coupled) holds[coupled.node] = {};
  for (const auto& tied : all_.tied) holds[tied.connection.node] = tied.apart;
  const ReadArray values(forces);
  for (PetscInt node = 0; node < mesh_.ownedNodes; ++node) {
    Point sum{};
    bool any = false;
    for (int d = 0; d < mesh_.dimension; ++d) {
      const PetscInt at = mesh_.dimension * node + d;
      if (!constraints.held[at] || constraints.heldBy[at] < 0 || !holds[node][d]) continue;
      const Point e = constraints.direction(node, d);
      sum = mesh::plus(sum, e, mesh::dot(e, componentsAt(mesh_, values.data(), node)));
      any = true;
    }
    if (any) addSupport(node, sum, found);
  }
}

ConditionForces Conditions::of(Vec forces) const {
  ConditionForces found;
  found.supports.resize(all_.constraints.groups.size());
  found.equations.resize(all_.constraints.equations.size());
  found.references.resize(mesh_.references.size());
  found.couplings.resize(all_.couplings.size() - mesh_.sections.size());
  found.bolts.resize(mesh_.sections.size());
  found.slaves.resize(all_.names.size());
  found.masters.resize(all_.names.size());
  const OwnedVec left = elasticity::nodalVector(mesh_);
  check(VecCopy(forces, left));
  if (!all_.constraints.origins.empty()) {
    const OwnedVec carried = elasticity::nodalVector(mesh_);
    check(VecCopy(forces, carried));
    transfer(carried, nullptr);
    takeEquations(multipliers(carried), left, found);
  }
  transfer(left, &found);
  addSupports(left, found);
  return found;
}

}  // namespace squeal::steady
