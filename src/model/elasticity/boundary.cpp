// SPDX-License-Identifier: BSD-2-Clause
#include "model/elasticity/boundary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/petsc/check.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "model/elasticity/face.hpp"
#include "model/element/shape.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::elasticity {
namespace {

using element::ShapeTable;
using element::shapeTable;
using mesh::Point;
using Corners = std::vector<int>;
/// The global numbers of the corners of a face, ascending; padded with −1 at the front.
using Key = std::array<PetscInt, 4>;

/// Returns the corners of the faces of a cell, in gmsh's numbers.
std::vector<Corners> cornersOf(const ShapeTable& cell) {
  if (cell.dimension == 2 && cell.corners == 3) return {{0, 1}, {1, 2}, {2, 0}};
  if (cell.dimension == 2 && cell.corners == 4) return {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  if (cell.corners == 4) return {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {3, 1, 2}};
  if (cell.corners == 5) return {{0, 1, 4}, {3, 0, 4}, {1, 2, 4}, {2, 3, 4}, {0, 3, 2, 1}};
  if (cell.corners == 6) return {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {0, 3, 5, 2}, {1, 2, 5, 4}};
  return {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}};
}

/// A face of a cell type.
struct LocalFace {
  int type = 0;
  std::vector<int> nodes;  // of the cell, in the order of the face's type
  std::size_t corners = 0;
};

/// Returns the face with these corners. A node of the cell lies on it if the linear shape functions
/// of the other corners are zero there; it corresponds to the node of the face with the same
/// values.
LocalFace faceOf(const ShapeTable& cell, const Corners& corners) {
  const auto value = [](const ShapeTable& table, int node, int corner) {
    return table.cornerValue[node * table.corners + corner];
  };
  std::vector<int> there;
  for (int node = 0; node < cell.nodes; ++node) {
    double sum = 0;
    for (const int corner : corners) sum += value(cell, node, corner);
    if (std::abs(sum - 1) < 1e-9) there.push_back(node);
  }
  for (const int type : {1, 8, 2, 9, 3, 16, 10}) {
    const ShapeTable& face = shapeTable(type);
    if (face.dimension != cell.dimension - 1 || face.corners != std::ssize(corners) ||
        face.nodes != std::ssize(there))
      continue;
    LocalFace result{type, {}, corners.size()};
    for (int i = 0; i < face.nodes; ++i)
      for (const int node : there) {
        double apart = 0;
        for (int k = 0; k < face.corners; ++k)
          apart = std::max(apart, std::abs(value(face, i, k) - value(cell, node, corners[k])));
        if (apart < 1e-9) result.nodes.push_back(node);
      }
    if (result.nodes.size() == there.size()) return result;
  }
  throw Error("the faces of cells of the type " + cell.name + " are not supported");
}

std::vector<LocalFace> facesOf(const ShapeTable& cell) {
  std::vector<LocalFace> faces;
  for (const auto& corners : cornersOf(cell)) faces.push_back(faceOf(cell, corners));
  return faces;
}

Point centreOf(const mesh::Mesh& mesh, std::span<const PetscInt> nodes) {
  Point sum{};
  for (const PetscInt node : nodes)
    sum = mesh::plus(sum, mesh.coordinates[node], 1.0 / nodes.size());
  return sum;
}

/// Returns the face of a cell of a body with its sign.
BoundaryFace boundaryFace(const mesh::Mesh& mesh, std::span<const PetscInt> cell, int body,
                          const LocalFace& local) {
  BoundaryFace face{local.type, {}, 1, body};
  std::vector<Point> points;
  for (const int node : local.nodes) {
    face.nodes.push_back(cell[node]);
    points.push_back(mesh.coordinates[cell[node]]);
  }
  const auto normals = faceNormals(shapeTable(local.type), points, 1);
  Point normal{};
  for (std::size_t i = 0; i < normals.size(); ++i) normal[i % 3] += normals[i];
  const Point outwards = mesh::minus(centreOf(mesh, face.nodes), centreOf(mesh, cell));
  if (mesh::dot(normal, outwards) < 0) face.sign = -1;
  return face;
}

/// The faces of exactly one cell of this rank, by key.
using Single = std::map<Key, BoundaryFace>;

Single singleFaces(const mesh::Mesh& mesh) {
  Single faces;
  for (const auto& block : mesh.cells) {
    const auto locals = facesOf(shapeTable(block.type));
    for (std::size_t e = 0; e < block.tag.size(); ++e)
      for (const auto& local : locals) {
        const auto cell = block.nodesOf(e);
        Key key;
        key.fill(-1);
        for (std::size_t k = 0; k < local.corners; ++k)
          key[k] = mesh.globalNode[cell[local.nodes[k]]];
        std::ranges::sort(key);
        const auto found = faces.find(key);
        if (found != faces.end())
          faces.erase(found);
        else
          faces.emplace(key, boundaryFace(mesh, cell, block.body[e], local));
      }
  }
  return faces;
}

/// Collective. Removes the faces that belong also to a cell of another rank. At least one of the
/// two ranks has a ghost among their nodes, so the ranks exchange only such faces.
void removeShared(const mesh::Mesh& mesh, Single& faces) {
  std::vector<Key> sent;
  for (const auto& [key, face] : faces)
    if (std::ranges::any_of(face.nodes, [&](PetscInt node) { return node >= mesh.ownedNodes; }))
      sent.push_back(key);
  const Concatenation ranks(mesh.comm, sent.size());
  const auto all = ranks.gathered(sent);
  std::vector<int> shared(all.size());
  for (int i = 0; i < ranks.size(); ++i)
    if (i < ranks.ownBegin() || i >= ranks.ownBegin() + std::ssize(sent))
      shared[i] = faces.contains(all[i]);
  mpi::reduce<int>(mesh.comm, shared, MPI_MAX);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (shared[i]) faces.erase(all[i]);
}

}  // namespace

std::vector<BoundaryFace> boundaryFaces(const mesh::Mesh& mesh) {
  Single faces;
  std::string failure;
  try {
    faces = singleFaces(mesh);
  } catch (const Error& error) {
    failure = error.what();
  }
  failTogether(mesh.comm, failure);
  removeShared(mesh, faces);
  std::vector<BoundaryFace> result;
  for (auto& [key, face] : faces) result.push_back(std::move(face));
  return result;
}

}  // namespace squeal::elasticity
