// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Resultants of nodal forces.
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/mesh/mesh.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::steady {

using mesh::Point;

/// A force and a moment about the origin of the global axes.
struct Wrench {
  Point force{};   ///< N
  Point moment{};  ///< N·m; in plane problems, only about z

  void add(const Wrench& other, double factor = 1) {
    force = mesh::plus(force, other.force, factor);
    moment = mesh::plus(moment, other.moment, factor);
  }
  /// Adds a force that acts at a point.
  void addForce(const Point& place, const Point& value, double factor = 1) {
    force = mesh::plus(force, value, factor);
    moment = mesh::plus(moment, mesh::cross(place, value), factor);
  }
  /// Adds a moment given by the components of a reference node: in plane problems, the first
  /// component is the moment about z.
  void addMoment(const Point& value, int dimension, double factor = 1) {
    moment = mesh::plus(moment, dimension == 3 ? value : Point{0, 0, value[0]}, factor);
  }
  /// Adds the force given by the components of an owned node. If this node is the rotation of a
  /// reference node, the components are a moment.
  void addNode(const mesh::Mesh& mesh, PetscInt node, const Point& value, double factor = 1) {
    if (mesh.isRotation(mesh.firstNode + node))
      addMoment(value, mesh.dimension, factor);
    else
      addForce(mesh.coordinates[node], value, factor);
  }
};

/// Collective. Returns the resultant of `forces`, N entries, over the nodes of this rank.
Wrench ownWrench(const mesh::Mesh& mesh, Vec forces);

/// Collective. Sums the wrenches over all ranks.
void reduce(MPI_Comm comm, const std::vector<Wrench*>& wrenches);

/// Not collective. Returns the components of an owned node; those beyond the dimension are zero.
Point componentsAt(const mesh::Mesh& mesh, const double* values, PetscInt node);

}  // namespace squeal::steady
