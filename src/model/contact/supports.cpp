// SPDX-License-Identifier: BSD-2-Clause
#include "model/contact/supports.hpp"

#include <algorithm>
#include <cmath>

#include "base/petsc/check.hpp"
#include "base/system/mpi.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::contact {
namespace {

/// Returns the direction of component d of a coupled node across the components that stay free.
Point coupledDirection(const constraints::CoupledNode& coupled, int d) {
  Point direction = mesh::axis(d);
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t e = 0; e < 3; ++e) direction[e] -= coupled.own[d][k] * coupled.own[e][k];
  return direction;
}

using Visit = std::function<void(const Support&)>;

void visitContact(const mesh::Mesh& mesh, const Contact& contact, const SupportingContact& holding,
                  const Visit& visit) {
  for (std::size_t i = 0; i < contact.interfaces.nodes.size(); ++i) {
    const auto& node = contact.interfaces.nodes[i];
    if (!holding.closed.empty() && !holding.closed[i]) continue;
    const bool sticks =
        node.role == Role::sticking && (holding.released.empty() || !holding.released[i]);
    Support support{.node = node.surfaceNode,
                    .position = node.position,
                    .direction = {},
                    .masterPosition = node.position,
                    .masterParts = node.masterParts,
                    .masters = contact.interfaces.connections[i].masters};
    const int sticking = sticks ? mesh.dimension : 0;
    for (int d = 0; d < sticking; ++d) {
      support.direction = mesh::axis(d);
      visit(support);
    }
    support.direction = node.normal;
    visit(support);
  }
}

/// Returns the entries of the row of a component of an owned node between the components of the
/// node. They span the directions of its springs.
Point springRow(const mesh::Mesh& mesh, Mat springs, PetscInt node, int component) {
  Point row{};
  if (!springs) return row;
  const PetscInt first = mesh.dimension * (mesh.firstNode + node), at = first + component;
  PetscInt count = 0;
  const PetscInt* columns = nullptr;
  const PetscScalar* values = nullptr;
  check(MatGetRow(springs, at, &count, &columns, &values));
  for (PetscInt i = 0; i < count; ++i) row[columns[i] - first] = values[i];
  check(MatRestoreRow(springs, at, &count, &columns, &values));
  return row;
}

}  // namespace

void forEachSupport(const mesh::Mesh& mesh, const Contact& contact, Mat springs,
                    const SupportingContact& holding, const Visit& visit) {
  const auto& constraints = contact.interfaces.constraints;
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    for (int d = 0; d < mesh.dimension; ++d) {
      const PetscInt i = mesh.dimension * node + d;
      const bool turned = constraints.axes.contains(node);
      Support support{.node = node, .position = mesh.coordinates[node], .direction = mesh::axis(d)};
      if (constraints.held[i] && !turned) visit(support);
      if (const Point force = springRow(mesh, springs, node, d); mesh::length(force) > 0) {
        for (std::size_t c = 0; c < 3; ++c) support.direction[c] = force[c] / mesh::length(force);
        if (!constraints.held[i] || turned || support.direction != mesh::axis(d)) visit(support);
      }
      if (!constraints.held[i] || !turned) continue;
      support.direction = constraints.direction(node, d);
      visit(support);
    }
  for (const auto& image : mesh.images) {
    const Point& x = mesh.coordinates[image.node];
    const coupling::PartShare part{image.primaryPart, 1};
    const coupling::Weight primary{image.primary, 1};
    for (int d = 0; d < mesh.dimension; ++d)
      visit({.node = image.node,
             .position = x,
             .direction = mesh::axis(d),
             .masterPosition = mesh::minus(x, image.shift),
             .masterParts = {&part, 1},
             .masters = {&primary, 1}});
  }
  if (holding.any) visitContact(mesh, contact, holding, visit);
  for (const auto& coupled : contact.interfaces.coupled)
    for (int d = 0; d < mesh.dimension; ++d)
      visit({.node = coupled.node,
             .position = mesh.coordinates[coupled.node],
             .direction = coupledDirection(coupled, d),
             .coupled = coupled.masters,
             .component = d});
  for (const auto& tied : contact.interfaces.tied) {
    const PetscInt node = tied.connection.node;
    for (int d = 0; d < mesh.dimension; ++d)
      visit({.node = node,
             .position = mesh.coordinates[node],
             .direction = mesh::axis(d),
             .masterPosition = mesh.coordinates[node],
             .masterParts = tied.masterParts,
             .masters = tied.connection.masters});
  }
}

void RigidMotions::add(std::vector<double>& row, int part, const Point& x, const Point& direction,
                       double factor) const {
  double* a = row.data() + part * perPart_;
  const Point r = mesh::scaled(mesh::minus(x, centre_), 1 / length_);
  for (int d = 0; d < dimension_; ++d) a[d] += factor * direction[d];
  //   direction · (e_k × r), k = 1, 2, 3
  const Point moment = mesh::cross(r, direction);
  if (dimension_ == 2)
    a[2] += factor * moment[2];
  else
    for (int k = 0; k < 3; ++k) a[3 + k] += factor * moment[k];
}

void RigidMotions::addRotation(std::vector<double>& row, int part, const Point& direction,
                               double factor) const {
  double* a = row.data() + part * perPart_;
  if (dimension_ == 2)
    a[2] += factor / length_ * direction[0];
  else
    for (int k = 0; k < 3; ++k) a[3 + k] += factor / length_ * direction[k];
}

void RigidMotions::addNode(const mesh::Mesh& mesh, PetscInt node, const Point& direction,
                           double factor, std::vector<double>& row) const {
  if (mesh.isRotation(mesh.globalNode[node]))
    addRotation(row, mesh.nodePart[node], direction, factor);
  else
    add(row, mesh.nodePart[node], mesh.coordinates[node], direction, factor);
}

void RigidMotions::addMaster(const constraints::CoupledMaster& master, int component,
                             std::vector<double>& row) const {
  if (master.isRotation)
    addRotation(row, master.part, master.block[component], -1);
  else
    add(row, master.part, master.position, master.block[component], -1);
}

RigidMotions rigidMotions(const mesh::Mesh& mesh) {
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  for (const auto& p : mesh.coordinates)
    for (std::size_t d = 0; d < 3; ++d)
      low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);
  mpi::reduce<double>(mesh.comm, low, MPI_MIN);
  mpi::reduce<double>(mesh.comm, high, MPI_MAX);
  double length = 0;
  for (int d = 0; d < 3; ++d) length = std::max(length, high[d] - low[d]);
  return {mesh, {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2}, length};
}

void GramMatrix::keep() {
  const int n = row.size();
  std::vector<int> used;
  for (int i = 0; i < n; ++i)
    if (row[i] != 0) used.push_back(i);
  for (const int j : used)
    for (const int i : used) sum(i, j) += row[i] * row[j];
  std::ranges::fill(row, 0.0);
}

void addEquations(const mesh::Mesh& mesh, const Contact& contact, const elasticity::Bodies& bodies,
                  const RigidMotions& motions, GramMatrix& gram) {
  const auto keep = [&] {
    mpi::reduce<double>(mesh.comm, gram.row, MPI_SUM);
    double largest = 0;  // an equation may have factors of any size
    for (const double x : gram.row) largest = std::max(largest, std::abs(x));
    if (largest > 0)
      for (double& x : gram.row) x /= largest;
    if (mpi::rank(mesh.comm) > 0) std::ranges::fill(gram.row, 0.0);
    gram.keep();
  };
  for (const auto& equation : contact.interfaces.constraints.equations) {
    for (const auto& term : equation.terms) {
      const Point direction = mesh::scaled(
          mesh::axis(mesh.dimension == 2 && term.rotation ? 0 : term.component), term.factor);
      if (const PetscInt node = constraints::nodeOf(mesh, term); node >= 0)
        motions.addNode(mesh, node, direction, 1, gram.row);
    }
    keep();
  }
  for (const auto& deformation : bodies.links) {
    if (deformation.stiffness == 0) continue;
    for (const auto& term : deformation.terms)
      if (const PetscInt node = mesh.ownedNode(term.node); node >= 0)
        motions.addNode(mesh, node, term.direction, 1, gram.row);
    keep();
  }
}

}  // namespace squeal::contact
