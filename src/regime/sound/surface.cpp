// SPDX-License-Identifier: BSD-2-Clause
#include "regime/sound/surface.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "model/elasticity/assembly.hpp"
#include "model/elasticity/boundary.hpp"
#include "model/elasticity/face.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::sound {
namespace {

using elasticity::BoundaryFace;
using element::shapeTable;
using Marks = std::vector<unsigned char>;  // [local node]

/// Collective. Returns nodal values, [local node][component]; images get the values of their
/// primaries.
std::vector<double> withImages(const contact::Contact& contact, Vec values) {
  if (!contact.periodic) return elasticity::localValues(*contact.mesh, values);
  const OwnedVec copied = elasticity::nodalVector(*contact.mesh);
  check(MatMult(contact.periodic, values, copied));
  return elasticity::localValues(*contact.mesh, copied);
}

/// Collective. Returns marks at the nodes whose global numbers any rank has given and, with a
/// contact, at their images.
Marks marked(const mesh::Mesh& mesh, const std::vector<PetscInt>& globalNodes,
             const contact::Contact* contact = nullptr) {
  const OwnedVec marks = elasticity::nodalVector(mesh);
  for (const PetscInt node : globalNodes)
    check(VecSetValue(marks, mesh.dimension * node, 1, INSERT_VALUES));
  check(VecAssemblyBegin(marks));
  check(VecAssemblyEnd(marks));
  const auto values = contact ? withImages(*contact, marks) : elasticity::localValues(mesh, marks);
  Marks result(mesh.localNodes());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = values[mesh.dimension * i] != 0;
  return result;
}

/// Collective. Returns marks at the nodes of an interface, slaves and masters.
Marks nodesOf(const mesh::Mesh& mesh, const contact::Contact& contact, int interface) {
  std::vector<PetscInt> nodes;
  const auto add = [&](const interfaces::Connection& connection, PetscInt node) {
    nodes.push_back(mesh.globalNode[node]);
    for (const auto& master : connection.masters)
      if (master.value != 0) nodes.push_back(master.node);
  };
  for (std::size_t i = 0; i < contact.interfaces.nodes.size(); ++i)
    if (contact.interfaces.nodes[i].interface == interface)
      add(contact.interfaces.connections[i], contact.interfaces.nodes[i].surfaceNode);
  for (const auto& tied : contact.interfaces.tied)
    if (tied.interface == interface) add(tied.connection, tied.connection.node);
  return marked(mesh, nodes, &contact);
}

/// Collective. Returns lists of marks: a face is hidden if all its nodes are marked in one list.
std::vector<Marks> hiddenNodes(const mesh::Mesh& mesh, const contact::Contact& contact) {
  std::vector<Marks> lists;
  for (std::size_t i = 0; i < contact.interfaces.options.size(); ++i)
    lists.push_back(nodesOf(mesh, contact, i));
  std::vector<PetscInt> images, primaries;
  for (const auto& image : mesh.images) {
    images.push_back(mesh.globalNode[image.node]);
    primaries.push_back(image.primary);
  }
  lists.push_back(marked(mesh, images)), lists.push_back(marked(mesh, primaries));
  return lists;
}

/// Collective. Returns 1 for components that a support holds, [local node · dimension + component].
std::vector<double> heldComponents(const mesh::Mesh& mesh, const contact::Contact& contact) {
  const OwnedVec held = elasticity::nodalVector(mesh);
  {
    const WriteArray values(held);
    for (PetscInt i = 0; i < values.size(); ++i)
      values[i] = contact.interfaces.constraints.holds(
          i / mesh.dimension, mesh::axis(i % mesh.dimension), mesh.dimension);
  }
  return withImages(contact, held);
}

/// A face with its normals at the nodes.
struct Face {
  std::vector<Point> points, normals;
};

Face geometryOf(const mesh::Mesh& mesh, const BoundaryFace& face) {
  Face result;
  for (const PetscInt node : face.nodes) result.points.push_back(mesh.coordinates[node]);
  result.normals = elasticity::nodeNormals(shapeTable(face.type), result.points, face.sign);
  return result;
}

/// Returns true if supports hold the normal displacement of all nodes.
bool isHeld(const mesh::Mesh& mesh, const std::vector<double>& held, const BoundaryFace& face,
            const std::vector<Point>& normals) {
  constexpr double alongTheFace = 1e-3;  // of a unit normal: round-off of CAD programs
  for (std::size_t i = 0; i < face.nodes.size(); ++i)
    for (int d = 0; d < mesh.dimension; ++d)
      if (std::abs(normals[i][d]) > alongTheFace && !held[mesh.dimension * face.nodes[i] + d])
        return false;
  return true;
}

/// Collective. Returns the unit normals at the owned nodes from sums of those of the faces.
std::vector<Point> unitNormals(const mesh::Mesh& mesh, Vec sums) {
  check(VecAssemblyBegin(sums));
  check(VecAssemblyEnd(sums));
  std::vector<Point> normals(mesh.ownedNodes);
  const ReadArray values(sums);
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node) {
    Point sum{};
    for (int d = 0; d < mesh.dimension; ++d) sum[d] = values[mesh.dimension * node + d];
    if (mesh::length(sum) > 0) normals[node] = mesh::unit(sum);
  }
  return normals;
}

/// Returns true if all nodes of the face are marked in one list.
bool isHidden(const std::vector<Marks>& lists, const BoundaryFace& face) {
  return std::ranges::any_of(lists, [&](const Marks& marks) {
    return std::ranges::all_of(face.nodes, [&](PetscInt node) { return marks[node]; });
  });
}

}  // namespace

RadiatingSurface radiatingSurface(const mesh::Mesh& mesh, const contact::Contact& contact) {
  const auto hidden = hiddenNodes(mesh, contact);
  const auto held = heldComponents(mesh, contact);
  const OwnedVec sums = elasticity::nodalVector(mesh);
  elasticity::Triples triples;
  RadiatingSurface surface;
  for (const auto& face : elasticity::boundaryFaces(mesh)) {
    const auto [points, normals] = geometryOf(mesh, face);
    if (isHidden(hidden, face) || isHeld(mesh, held, face, normals)) continue;
    const auto& table = shapeTable(face.type);
    for (const double weight : elasticity::areaWeights(table, points)) surface.area += weight;
    elasticity::append(triples, mesh, face.nodes,
                       elasticity::normalMass(table, points, mesh.dimension));
    // Sums directions instead of ∫ φ n dA, which is zero at the corners of quadratic faces.
    for (std::size_t i = 0; i < face.nodes.size(); ++i)
      for (int d = 0; d < mesh.dimension; ++d)
        check(VecSetValue(sums, mesh.dimension * mesh.globalNode[face.nodes[i]] + d, normals[i][d],
                          ADD_VALUES));
  }
  surface.area = mpi::sum(mesh.comm, surface.area);
  surface.normalMass = elasticity::toMatrix(mesh, triples, elasticity::SymmetryClass::rounded);
  surface.normals = unitNormals(mesh, sums);
  return surface;
}

}  // namespace squeal::sound
