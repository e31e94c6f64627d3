// SPDX-License-Identifier: BSD-2-Clause
#include "regime/regime/contact_nodes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>

#include "base/petsc/arrays.hpp"
#include "base/system/termination.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/mesh/vector.hpp"
#include "regime/regime/columns.hpp"

namespace squeal::regime {
namespace {

using linalg::DenseMatrix;
using linalg::DenseView;
using mesh::Point;

/// Returns two unit vectors that span the tangent plane, the first along the slip if there is one.
std::array<Point, 2> tangentsOf(const Point& normal, const Point& slip, int dimension) {
  std::array<Point, 2> tangents{};
  Point first = slip;
  if (mesh::dot(first, first) == 0) {
    if (dimension == 2) {
      first = {normal[1], -normal[0], 0};
    } else {
      const int axis = std::ranges::min_element(normal, {}, [](double x) { return std::abs(x); }) -
                       normal.begin();
      first[axis] = 1;
      const double along = normal[axis];
      for (int d = 0; d < 3; ++d) first[d] -= along * normal[d];
    }
  }
  const double length = std::sqrt(mesh::dot(first, first));
  for (double& x : first) x /= length;
  tangents[0] = first;
  if (dimension == 3)
    tangents[1] = {normal[1] * first[2] - normal[2] * first[1],
                   normal[2] * first[0] - normal[0] * first[2],
                   normal[0] * first[1] - normal[1] * first[0]};
  return tangents;
}

}  // namespace

std::vector<Node> ownNodes(const contact::Contact& contact, const steady::Solution& solution) {
  const auto slip = steady::withReleased(contact, solution.slip, solution.sticking);
  std::array<std::vector<double>, 3> shear;
  for (int d = 0; d < 3; ++d) {
    for (const auto& state : solution.contact) shear[d].push_back(state.frictionForce[d]);
    shear[d] = contact.gapForce(shear[d]);
  }
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < contact.interfaces.nodes.size(); ++i) {
    const auto& from = contact.interfaces.nodes[i];
    const auto& state = solution.contact[i];
    Node node;
    node.interface = from.interface;
    node.position = from.position;
    node.normal = from.normal;
    node.tangents = tangentsOf(from.normal, slip[i].direction, contact.mesh->dimension);
    node.area = from.area;
    node.gap = solution.closed[i] ? 0 : state.coefficient;
    node.normalForce = solution.closed[i] ? state.normalForce : 0;
    if (from.role == contact::Role::sliding) {
      node.friction = slip[i].friction(solution.at.friction);
      node.lawCoefficient = slip[i].coefficient.at(solution.at.friction);
      node.frictionSlope = slip[i].frictionSlope(solution.at.friction);
      node.sweptFriction = slip[i].friction(solution.at.friction + 1) - node.friction;
      node.velocity = {slip[i].speed, 0};
      node.shear = {-node.friction * node.normalForce, 0};
    } else if (from.role == contact::Role::sticking) {
      node.friction = contact.interfaces.options[from.interface].stickingLimit.value_or(INFINITY);
      for (int a = 0; a < 2; ++a)
        for (int d = 0; d < 3; ++d) node.shear[a] += node.tangents[a][d] * shear[d][i];
    }
    nodes.push_back(node);
  }
  return nodes;
}

/// Collective. Returns the jumps of nodal displacements, the rows of this rank's nodes.
DenseMatrix ownJumps(const contact::Contact& contact, const std::vector<Node>& nodes,
                     const DenseView& u) {
  const int dimension = contact.mesh->dimension;
  DenseMatrix rows(std::ssize(nodes) * dimension);
  OwnedVec jump = elasticity::nodalVector(*contact.mesh);
  for (PetscInt j = 0; j < u.columns(); ++j) {
    if (j % blockColumns == 0) stopIfRequested(contact.mesh->comm);
    check(MatMult(contact.sliding.jump, borrowedVector(contact.mesh->comm, u.column(j)), jump));
    std::vector<double> column(nodes.size() * dimension);
    const ReadArray values(jump);
    for (int c = 0; c < dimension; ++c) {
      std::vector<double> component;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Point& direction = c == 0 ? nodes[i].normal : nodes[i].tangents[c - 1];
        double sum = 0;
        for (int d = 0; d < dimension; ++d)
          sum += direction[d] * values[dimension * contact.interfaces.nodes[i].node + d];
        component.push_back(sum);
      }
      component = contact.gapCoefficients(component);
      for (std::size_t i = 0; i < nodes.size(); ++i) column[i * dimension + c] = component[i];
    }
    rows.append(std::span<const double>(column));
  }
  return rows;
}

Order::Order(MPI_Comm comm, const std::vector<Node>& own) : comm_(comm), ranks_(comm, own.size()) {
  const auto all = ranks_.gathered(own);
  std::vector<PetscInt> sorted(all.size());
  std::iota(sorted.begin(), sorted.end(), 0);
  std::ranges::sort(sorted, {},
                    [&](PetscInt i) { return std::tuple(all[i].interface, all[i].position); });
  place_.resize(all.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    place_[sorted[i]] = i;
    nodes_.push_back(all[sorted[i]]);
    const PetscInt local = sorted[i] - ranks_.ownBegin();
    own_.push_back(local >= 0 && local < std::ssize(own) ? local : -1);
  }
}

DenseMatrix Order::gathered(const DenseView& own, PetscInt perNode) const {
  // Node by node, so the part of a rank is contiguous.
  const PetscInt columns = own.columns(), entries = perNode * columns;
  std::vector<double> packed(own.size());
  for (PetscInt j = 0; j < columns; ++j)
    for (PetscInt i = 0; i < own.rows(); ++i)
      packed[i / perNode * entries + i % perNode * columns + j] = own(i, j);
  const auto all = Concatenation(comm_, packed.size()).gathered(packed);
  DenseMatrix result(std::ssize(nodes_) * perNode, columns);
  for (std::size_t node = 0; node < place_.size(); ++node)
    for (PetscInt c = 0; c < perNode; ++c)
      for (PetscInt j = 0; j < columns; ++j)
        result(place_[node] * perNode + c, j) = all[node * entries + c * columns + j];
  return result;
}

}  // namespace squeal::regime
