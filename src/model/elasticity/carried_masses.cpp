// SPDX-License-Identifier: BSD-2-Clause
#include "model/elasticity/carried_masses.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/session/stages.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/error.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/elasticity/assembly.hpp"

namespace squeal::elasticity {
namespace {

using attachments::PointMass;
using mesh::cross;
using mesh::Matrix3;

Point product(const Matrix3& matrix, const Point& vector) {
  return {mesh::dot(matrix[0], vector), mesh::dot(matrix[1], vector), mesh::dot(matrix[2], vector)};
}

/// The bodies that nodes and couplings connect with a group of nodes or a reference node.
class Connections {
 public:
  Connections(const mesh::Mesh& mesh, const std::vector<constraints::CouplingSettings>& couplings)
      : mesh_(mesh) {
    for (const auto& coupling : couplings)
      for (const auto& group : coupling.groups) {
        next_[coupling.reference].insert(group);
        if (mesh.reference(group)) next_[group].insert(coupling.reference);
      }
  }
  /// Collective. Returns indices of bodies.
  std::set<int> bodiesOf(const std::string& group) const;

 private:
  void addBodies(const std::string& group, std::vector<int>& found) const;
  const mesh::Mesh& mesh_;
  std::map<std::string, std::set<std::string>> next_;  // [reference node] groups, reference nodes
};

/// Collective. Sets the entries of the bodies that have nodes of a group, [body], on this rank.
void Connections::addBodies(const std::string& group, std::vector<int>& found) const {
  std::vector<PetscInt> own;
  for (const PetscInt node : mesh_.nodeGroups.at(group)) own.push_back(mesh_.firstNode + node);
  const auto all = concatenated(mesh_.comm, own);
  const std::set<PetscInt> nodes(all.begin(), all.end());
  for (const auto& block : mesh_.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e)
      for (const PetscInt node : block.nodesOf(e))
        if (nodes.contains(mesh_.globalNode[node])) found[block.body[e]] = 1;
}

std::set<int> Connections::bodiesOf(const std::string& group) const {
  std::vector<int> found(mesh_.bodies.size(), 0);
  std::set<std::string> seen{group};
  std::vector<std::string> open{group};
  while (!open.empty()) {
    const std::string current = open.back();
    open.pop_back();
    if (!mesh_.reference(current)) addBodies(current, found);
    if (const auto known = next_.find(current); known != next_.end())
      for (const auto& other : known->second)
        if (seen.insert(other).second) open.push_back(other);
  }
  mpi::reduce<int>(mesh_.comm, found, MPI_MAX);
  std::set<int> bodies;
  for (std::size_t b = 0; b < found.size(); ++b)
    if (found[b] > 0) bodies.insert(b);
  return bodies;
}

bool isEqual(const Motion& a, const Motion& b) {
  return a.translation == b.translation && a.speed == b.speed &&
         (a.speed == 0 || (a.axis == b.axis && a.origin == b.origin));
}

/// Collective. Returns the moving body that carries a mass; −1 if there is none.
int carrier(const mesh::Mesh& mesh, const std::string& group, const std::set<int>& bodies,
            const std::vector<Motion>& motions) {
  if (std::ranges::none_of(bodies, [&](int body) { return motions[body].moves(); })) return -1;
  const int first = *bodies.begin();
  if (std::ranges::all_of(bodies, [&](int body) { return isEqual(motions[body], motions[first]); }))
    return first;
  std::vector<std::string> names;
  for (const int body : bodies) names.push_back("'" + mesh.bodies[body] + "'");
  printWarning(mesh.comm, "warning: option " + attachments::massName(group) +
                              ": the mass belongs to bodies that move differently (" +
                              joined(names) +
                              "), so it has no centrifugal forces and no gyroscopic terms");
  return -1;
}

/// Collective. Returns the largest distance of a body from the axis of its rotation.
double radiusOf(const mesh::Mesh& mesh, int body, const Motion& motion) {
  double radius = 0;
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e)
      for (const PetscInt node : block.nodesOf(e))
        if (block.body[e] == body)
          radius = std::max(radius,
                            mesh::length(mesh::tangential(
                                mesh::minus(mesh.coordinates[node], motion.origin), motion.axis)));
  return mpi::max(mesh.comm, radius);
}

/// Returns the largest entry of an inertia that is not that of a figure of revolution about the
/// axis, relative to the largest one.
double unsymmetry(const Matrix3& inertia, const Point& axis) {
  const double polar = mesh::dot(axis, product(inertia, axis)),
               across = (inertia[0][0] + inertia[1][1] + inertia[2][2] - polar) / 2;
  double worst = 0, largest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double round = polar * axis[i] * axis[j] + across * ((i == j) - axis[i] * axis[j]);
      worst = std::max(worst, std::abs(inertia[i][j] - round));
      largest = std::max(largest, std::abs(inertia[i][j]));
    }
  return largest > 0 ? worst / largest : 0;
}

/// Collective. Throws Error unless a mass is steady in the axes of the vehicle.
void requireSteady(const mesh::Mesh& mesh, const CarriedMass& carried, const Motion& motion) {
  constexpr double tolerance = 1e-3;
  const auto& mass = carried.mass;
  std::string why;
  if (motion.speed == 0) {
    why = "which translates, so that it does not stay at its place";
  } else {
    const Point r = mesh::tangential(mesh::minus(mass.centre(), motion.origin), motion.axis);
    if (mesh::length(r) > tolerance * radiusOf(mesh, carried.body, motion))
      why = formatted("and its centre is %.3g m off the axis of the rotation", mesh::length(r));
    else if (mesh.dimension == 3 && unsymmetry(mass.inertia, motion.axis) > tolerance)
      why = "and its inertia is not that of a figure of revolution about the axis";
  }
  if (!why.empty())
    throw Error("option " + attachments::massName(mass.group) + ": the mass moves with body '" +
                mesh.bodies[carried.body] + "', " + why +
                ": it is not steady in the axes of the vehicle; use -motion_convective off "
                "(approximation A)");
}

}  // namespace

std::vector<CarriedMass> carriedMasses(const mesh::Mesh& mesh, const Settings& settings,
                                       const std::vector<constraints::CouplingSettings>& couplings,
                                       const std::vector<Motion>& motions) {
  std::vector<CarriedMass> carried;
  if (settings.attachments.masses.empty() || std::ranges::none_of(motions, &Motion::moves))
    return carried;
  const Connections connections(mesh, couplings);
  std::map<std::string, int> carriers;  // [group]
  for (const auto& given : settings.attachments.masses)
    carriers[given.group] = carrier(mesh, given.group, connections.bodiesOf(given.group), motions);
  for (auto& mass : attachments::pointMasses(mesh, settings.attachments)) {
    const int body = carriers.at(mass.group);
    if (body < 0) continue;
    carried.push_back({std::move(mass), body});
    if (settings.convective) requireSteady(mesh, carried.back(), motions[body]);
  }
  return carried;
}

void addCentrifugal(const mesh::Mesh& mesh, const std::vector<CarriedMass>& masses,
                    const std::vector<Motion>& motions, Vec forces) {
  const int n = mesh.dimension;
  for (const auto& [mass, body] : masses) {
    const Motion& motion = motions[body];
    if (motion.speed == 0) continue;
    const double square = motion.speed * motion.speed;
    const Point r = mesh::tangential(mesh::minus(mass.centre(), motion.origin), motion.axis),
                force = mesh::scaled(r, mass.mass * square);
    //   −ω² k × J k
    const Point moment = mesh::plus(
        cross(mass.arm, force), cross(motion.axis, product(mass.inertia, motion.axis)), -square);
    const auto add = [&](PetscInt node, const Point& value) {
      if (mesh.ownedNode(node) < 0) return;
      for (int d = 0; d < n; ++d) check(VecSetValue(forces, n * node + d, value[d], ADD_VALUES));
    };
    add(mass.node.displacement, force);
    if (mass.node.rotation >= 0) add(mass.node.rotation, n == 3 ? moment : Point{moment[2], 0, 0});
  }
  check(VecAssemblyBegin(forces));
  check(VecAssemblyEnd(forces));
}

OwnedMat gyroscopicOf(const mesh::Mesh& mesh, const std::vector<CarriedMass>& masses,
                      const std::vector<Motion>& motions) {
  if (mesh.dimension == 2) return {};  // the axis of the rotation keeps its direction
  Triples triples;
  bool any = false;
  for (const auto& [mass, body] : masses) {
    const Motion& motion = motions[body];
    const double spin = motion.speed * mesh::dot(motion.axis, product(mass.inertia, motion.axis));
    if (spin == 0) continue;
    any = true;
    if (mpi::rank(mesh.comm) > 0) continue;
    //   ω J_k (θ_t × k)
    for (int j = 0; j < 3; ++j) {
      const Point column = mesh::scaled(cross(mesh::axis(j), motion.axis), spin);
      for (int i = 0; i < 3; ++i)
        if (i != j) triples.add(3 * mass.node.rotation + i, 3 * mass.node.rotation + j, column[i]);
    }
  }
  if (!any) return {};
  return toMatrix(mesh, triples, SymmetryClass::skew);
}

}  // namespace squeal::elasticity
