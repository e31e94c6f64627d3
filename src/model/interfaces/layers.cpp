// SPDX-License-Identifier: BSD-2-Clause
#include "model/interfaces/layers.hpp"

#include <cmath>
#include <vector>

#include "base/petsc/arrays.hpp"
#include "model/elasticity/assembly.hpp"
#include "model/elasticity/face.hpp"
#include "model/element/shape.hpp"
#include "model/interfaces/algebra.hpp"

namespace squeal::interfaces {
namespace {

/// Collective. Returns a nodal vector at the nodes on the faces below layers and at their images;
/// `set` fills the components of contact node k.
template <class Set>
OwnedVec onFaces(const mesh::Mesh& mesh, const Interfaces& all, Mat periodic, const Set& set) {
  const OwnedVec own = elasticity::nodalVector(mesh);
  {
    const WriteArray values(own);
    for (const auto& node : all.nodes)
      if (node.hasLayer()) set(node, values.begin() + mesh.dimension * node.surfaceNode);
  }
  OwnedVec folded = elasticity::nodalVector(mesh);
  check(MatMult(periodic, own, folded));
  return folded;
}

/// Returns √(k c) of a contact node with the covered part c of its area.
double root(double stiffness, const ContactNode& node) {
  return std::sqrt(stiffness * node.area / node.wholeArea);
}

/// Collective. Returns a mark at the components of the nodes on the faces below layers.
OwnedVec marks(const mesh::Mesh& mesh, const Interfaces& all, Mat periodic) {
  return onFaces(mesh, all, periodic, [](const ContactNode&, double* at) { *at = 1; });
}

bool anyLayer(const mesh::Mesh& mesh, const Interfaces& all) {
  return mesh.layerNodes > 0 && std::ranges::any_of(all.options, [](const auto& interface) {
           return interface.layerStiffness > 0;
         });
}

/// The springs of the layers at all local nodes, [local node][component].
struct Springs {
  std::vector<double> normal;      // √k n
  std::vector<double> tangential;  // √k_t in the first component
  std::vector<double> direction;   // n
};

Springs springsOf(const mesh::Mesh& mesh, const Interfaces& all, Mat periodic) {
  const int dimension = mesh.dimension;
  const auto local = [&](const auto& set) {
    return elasticity::localValues(mesh, onFaces(mesh, all, periodic, set));
  };
  return {local([&](const ContactNode& node, double* at) {
            const double factor = root(all.options[node.interface].layerStiffness, node);
            for (int d = 0; d < dimension; ++d) at[d] = factor * node.normal[d];
          }),
          local([&](const ContactNode& node, double* at) {
            *at = root(all.options[node.interface].layerTangentialStiffness, node);
          }),
          local([&](const ContactNode& node, double* at) {
            for (int d = 0; d < dimension; ++d) at[d] = node.normal[d];
          })};
}

/// Returns the block of two nodes, row-major, per ∫ φ_i φ_j dA.
std::vector<double> blockOf(const Springs& springs, PetscInt a, PetscInt b, int dimension) {
  const double *na = springs.normal.data() + dimension * a,
               *nb = springs.normal.data() + dimension * b,
               *ea = springs.direction.data() + dimension * a,
               *eb = springs.direction.data() + dimension * b;
  const double tangential = springs.tangential[dimension * a] * springs.tangential[dimension * b];
  double cosine = 0;
  for (int d = 0; d < dimension; ++d) cosine += ea[d] * eb[d];
  std::vector<double> block(dimension * dimension);
  //   √k_i n_i √k_j n_jᵀ + √k_t,i (1 − n_i n_iᵀ) √k_t,j (1 − n_j n_jᵀ)
  for (int i = 0; i < dimension; ++i)
    for (int j = 0; j < dimension; ++j)
      block[i * dimension + j] =
          na[i] * nb[j] +
          tangential * ((i == j ? 1 : 0) - ea[i] * ea[j] - eb[i] * eb[j] + cosine * ea[i] * eb[j]);
  return block;
}

/// Collective. Returns the matrix of the springs on the differences u_P − u_L, in the rows of P.
OwnedMat springMatrix(const mesh::Mesh& mesh, const Interfaces& all, const Springs& springs) {
  const int dimension = mesh.dimension;
  elasticity::Triples triples;
  for (const auto& block : mesh.faces) {
    const auto& table = element::shapeTable(block.type);
    const int n = block.nodesPerFace, size = n * dimension;
    for (std::size_t e = 0; e < block.surface.size(); ++e) {
      const SlaveSide* slave = all.slaveOf(mesh.surfaces[block.surface[e]]);
      if (!slave) continue;
      const auto nodes = block.nodesOf(e);
      std::vector<Point> points;
      for (const PetscInt node : nodes) points.push_back(mesh.coordinates[node]);
      const auto mass = elasticity::faceMass(table, points);
      std::vector<double> matrix(size * size, 0.0);
      for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b) {
          if (!all.hasGapOn(slave->surface, nodes[a]) || !all.hasGapOn(slave->surface, nodes[b]))
            continue;
          const auto entries = blockOf(springs, nodes[a], nodes[b], dimension);
          for (int i = 0; i < dimension; ++i)
            for (int j = 0; j < dimension; ++j)
              matrix[(a * dimension + i) * size + b * dimension + j] =
                  mass[a * n + b] * entries[i * dimension + j];
        }
      elasticity::append(triples, mesh, nodes, matrix);
    }
  }
  return elasticity::toMatrix(mesh, triples, elasticity::SymmetryClass::symmetric);
}

/// Collective. Returns the matrix of the differences u_P − u_L, in the rows of P.
OwnedMat differences(const mesh::Mesh& mesh, Vec below) {
  OwnedMat rows = nodalMatrix(mesh, 2);
  const ReadArray isBelow(below);
  for (const auto& [node, layer] : mesh.layers) {
    if (isBelow[mesh.dimension * node] == 0) continue;
    setBlock(rows, mesh.dimension, mesh.firstNode + node, mesh.firstNode + node,
             identity(mesh.dimension, 1));
    setBlock(rows, mesh.dimension, mesh.firstNode + node, mesh.firstNode + layer,
             identity(mesh.dimension, -1));
  }
  assembled(rows);
  return rows;
}

}  // namespace

OwnedMat layerExchange(const mesh::Mesh& mesh, const Interfaces& all, Mat periodic) {
  if (!anyLayer(mesh, all)) return {};
  const OwnedVec below = marks(mesh, all, periodic);
  const ReadArray isBelow(below);
  std::vector<PetscInt> other(mesh.ownedNodes);
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node) other[node] = node;
  for (const auto& [node, layer] : mesh.layers)
    if (isBelow[mesh.dimension * node] != 0) other[node] = layer, other[layer] = node;
  OwnedMat exchange = nodalMatrix(mesh, 1);
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    for (int d = 0; d < mesh.dimension; ++d)
      check(MatSetValue(exchange, mesh.dimension * (mesh.firstNode + node) + d,
                        mesh.dimension * (mesh.firstNode + other[node]) + d, 1, INSERT_VALUES));
  assembled(exchange);
  return exchange;
}

OwnedMat layerStiffness(const mesh::Mesh& mesh, const Interfaces& all, Mat periodic) {
  if (!anyLayer(mesh, all)) return {};
  const OwnedMat springs = springMatrix(mesh, all, springsOf(mesh, all, periodic)),
                 rows = differences(mesh, marks(mesh, all, periodic));
  OwnedMat stiffness;
  check(MatPtAP(springs, rows, MAT_INITIAL_MATRIX, PETSC_DEFAULT, stiffness.out()));
  check(MatProductClear(stiffness));
  return stiffness;
}

}  // namespace squeal::interfaces
