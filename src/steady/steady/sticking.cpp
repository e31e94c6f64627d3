// SPDX-License-Identifier: BSD-2-Clause
#include "steady/steady/sticking.hpp"

#include <algorithm>
#include <cmath>

#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "model/mesh/vector.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::steady {

namespace {

/// A smaller slip along the friction, relative to the largest jump, is round-off.
constexpr double slipRounding = 1e-8;

/// Collective. Returns the jumps along the surface, m, [contact node].
std::vector<Point> tangentialJumps(const contact::Contact& contact, Vec displacement) {
  const auto& mesh = *contact.mesh;
  const OwnedVec jump = elasticity::nodalVector(mesh);
  check(MatMult(contact.sliding.jump, displacement, jump));
  const ReadArray values(jump);
  std::vector<Point> found;
  for (const auto& node : contact.interfaces.nodes) {
    Point u{};
    for (int d = 0; d < mesh.dimension; ++d) u[d] = values[mesh.dimension * node.node + d];
    found.push_back(mesh::tangential(u, node.normal));
  }
  return found;
}

double largestLength(MPI_Comm comm, const std::vector<Point>& points) {
  double largest = 0;
  for (const auto& point : points) largest = std::max(largest, mesh::length(point));
  largest = mpi::max(comm, largest);
  return largest;
}

}  // namespace

Sticking Sticking::allHeld(const contact::Contact& contact) {
  return {std::vector<Hold>(contact.interfaces.nodes.size(), Hold::held),
          std::vector<Point>(contact.interfaces.nodes.size(), Point{}),
          contact::Mask(contact.interfaces.nodes.size(), 0),
          contact::Mask(contact.interfaces.nodes.size(), 0)};
}

Sticking Sticking::allFree(const contact::Contact& contact) {
  Sticking sticking = allHeld(contact);
  std::fill(sticking.holds.begin(), sticking.holds.end(), Hold::open);
  return sticking;
}

contact::Mask Sticking::free() const {
  contact::Mask found;
  for (const Hold hold : holds) found.push_back(hold != Hold::held);
  return found;
}

std::vector<contact::Slip> withReleased(const contact::Contact& contact,
                                        std::vector<contact::Slip> slip, const Sticking& sticking) {
  for (std::size_t i = 0; i < slip.size(); ++i)
    if (sticking.holds[i] == Hold::released)
      slip[i] = {
          sticking.direction[i],
          0,
          1,
          0,
          {*contact.interfaces.options[contact.interfaces.nodes[i].interface].stickingLimit, 0}};
  return slip;
}

bool isPulled(const contact::Contact& contact, const Solution& solution, std::size_t i) {
  return !contact.interfaces.nodes[i].separates &&
         solution.contact[i].normalForce < -solution.negligibleForce;
}

bool exceedsLimit(const contact::Contact& contact, const Solution& solution, std::size_t i) {
  const auto& limit =
      contact.interfaces.options[contact.interfaces.nodes[i].interface].stickingLimit;
  const auto& state = solution.contact[i];
  return limit && solution.closed[i] && solution.sticking.holds[i] == Hold::held &&
         mesh::length(state.frictionForce) >
             *limit * std::max(state.normalForce, 0.0) + solution.negligibleForce;
}

namespace {

/// Returns by what factor each pressed node exceeds its limit of friction, [contact node]; infinity
/// for a node without pressure, 0 where the limit is not exceeded or the interface releases no
/// node.
std::vector<double> excesses(const contact::Contact& contact, const Solution& solution) {
  std::vector<double> found;
  for (std::size_t i = 0; i < contact.interfaces.nodes.size(); ++i) {
    const auto& options = contact.interfaces.options[contact.interfaces.nodes[i].interface];
    const auto& state = solution.contact[i];
    if (!options.releases || !exceedsLimit(contact, solution, i))
      found.push_back(0);
    else if (const double limit = *options.stickingLimit * state.normalForce; limit > 0)
      found.push_back(mesh::length(state.frictionForce) / limit);
    else
      found.push_back(INFINITY);
  }
  return found;
}

/// Collective. Returns 1 for the released nodes that are closed and slide in the direction of their
/// friction force, [contact node].
contact::Mask slidingBack(const contact::Contact& contact, const Solution& solution) {
  const auto jumps = tangentialJumps(contact, solution.displacement);
  const double nothing = slipRounding * largestLength(contact.mesh->comm, jumps);
  const auto& sticking = solution.sticking;
  contact::Mask found;
  for (std::size_t i = 0; i < jumps.size(); ++i)
    found.push_back(sticking.holds[i] == Hold::released && solution.closed[i] &&
                    mesh::dot(sticking.direction[i], jumps[i]) < -nothing);
  return found;
}

}  // namespace

void countReturned(const contact::Contact& contact, Solution& solution) {
  if (!contact.hasSticking()) return;
  const auto back = slidingBack(contact, solution);
  std::vector<PetscInt> counts(contact.interfaces.names.size(), 0);
  for (std::size_t i = 0; i < back.size(); ++i)
    counts[contact.interfaces.nodes[i].interface] += back[i];
  mpi::reduce<PetscInt>(contact.mesh->comm, counts, MPI_SUM);
  auto resultant = solution.resultants.begin();  // tied interfaces have none
  for (std::size_t k = 0; k < counts.size(); ++k)
    if (!contact.interfaces.options[k].isTied()) (resultant++)->returned = counts[k];
}

std::optional<Sticking> revised(const contact::Contact& contact, const Solution& solution) {
  if (!contact.hasSticking()) return {};
  const MPI_Comm comm = contact.mesh->comm;
  const auto back = slidingBack(contact, solution);
  Sticking next = solution.sticking;
  const auto excess = excesses(contact, solution);
  double largest = 0;  // of the nodes that have slid back
  for (std::size_t i = 0; i < excess.size(); ++i)
    if (next.slidBack[i] > 0 && std::isfinite(excess[i])) largest = std::max(largest, excess[i]);
  largest = mpi::max(comm, largest);
  const double most = 1 + 0.5 * (largest - 1);
  for (std::size_t i = 0; i < contact.interfaces.nodes.size(); ++i) {
    const auto& node = contact.interfaces.nodes[i];
    Hold& hold = next.holds[i];
    if (node.role != contact::Role::sticking) continue;
    if (!solution.closed[i]) {
      hold = Hold::open;
    } else if (hold == Hold::open) {
      hold = next.heldAgain[i] ? Hold::open : Hold::held;
      next.heldAgain[i] = 1;
    } else if (back[i]) {
      if (next.slidBack[i] == mostReturns) continue;
      hold = Hold::held;
      ++next.slidBack[i];
    } else if (excess[i] > 0 && (next.slidBack[i] == 0 || excess[i] >= most)) {
      hold = Hold::released;
      next.direction[i] = mesh::scaled(mesh::unit(solution.contact[i].frictionForce), -1);
    }
  }
  if (mpi::all(comm, next.holds == solution.sticking.holds)) return {};
  return next;
}

}  // namespace squeal::steady
