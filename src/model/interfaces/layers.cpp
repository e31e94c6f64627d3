// SPDX-License-Identifier: BSD-2-Clause
#include "model/interfaces/layers.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
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

bool anyLayer(const mesh::Mesh& mesh, const Interfaces& all) {
  return mesh.layerNodes > 0 && std::ranges::any_of(all.options, [](const auto& interface) {
           return interface.layerStiffness > 0;
         });
}

/// The springs of the layers at all local nodes, [local node][component].
struct Springs {
  std::vector<double> normal;  // n
  std::vector<double> roots;   // √k, √k_t in the first two components
};

Springs springsOf(const mesh::Mesh& mesh, const Interfaces& all, Mat periodic) {
  const int dimension = mesh.dimension;
  const auto local = [&](const auto& set) {
    return elasticity::localValues(mesh, onFaces(mesh, all, periodic, set));
  };
  return {local([&](const ContactNode& node, double* at) {
            for (int d = 0; d < dimension; ++d) at[d] = node.normal[d];
          }),
          local([&](const ContactNode& node, double* at) {
            const auto& interface = all.options[node.interface];
            at[0] = root(interface.layerStiffness, node);
            at[1] = root(interface.layerTangentialStiffness, node);
          })};
}

/// Returns the block of two nodes, row-major, per ∫ φ_i φ_j dA.
std::vector<double> blockOf(const Springs& springs, PetscInt a, PetscInt b, int dimension) {
  const double *na = springs.normal.data() + dimension * a,
               *nb = springs.normal.data() + dimension * b,
               *ra = springs.roots.data() + dimension * a,
               *rb = springs.roots.data() + dimension * b;
  const double tangential = ra[1] * rb[1];
  double cosine = 0;
  for (int d = 0; d < dimension; ++d) cosine += na[d] * nb[d];
  std::vector<double> block(dimension * dimension);
  //   √k_i n_i √k_j n_jᵀ + √k_t,i (1 − n_i n_iᵀ) √k_t,j (1 − n_j n_jᵀ)
  for (int i = 0; i < dimension; ++i)
    for (int j = 0; j < dimension; ++j)
      block[i * dimension + j] =
          ra[0] * na[i] * (rb[0] * nb[j]) +
          tangential * ((i == j ? 1 : 0) - na[i] * na[j] - nb[i] * nb[j] + cosine * na[i] * nb[j]);
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
OwnedMat differences(const mesh::Mesh& mesh, const std::vector<mesh::LayerNode>& layers) {
  OwnedMat rows = nodalMatrix(mesh, 2);
  for (const auto& [node, layer] : layers) {
    setBlock(rows, mesh.dimension, mesh.firstNode + node, mesh.firstNode + node,
             identity(mesh.dimension, 1));
    setBlock(rows, mesh.dimension, mesh.firstNode + node, mesh.firstNode + layer,
             identity(mesh.dimension, -1));
  }
  assembled(rows);
  return rows;
}

}  // namespace

std::vector<mesh::LayerNode> layersInContact(const mesh::Mesh& mesh, const Interfaces& all,
                                             Mat periodic) {
  if (!anyLayer(mesh, all)) return {};
  const OwnedVec marks =
      onFaces(mesh, all, periodic, [](const ContactNode&, double* at) { *at = 1; });
  const ReadArray isBelow(marks);
  std::vector<mesh::LayerNode> layers;
  std::ranges::copy_if(mesh.layers, std::back_inserter(layers),
                       [&](const auto& one) { return isBelow[mesh.dimension * one.node] != 0; });
  return layers;
}

OwnedMat layerExchange(const mesh::Mesh& mesh, const Interfaces& all) {
  if (!anyLayer(mesh, all)) return {};
  std::vector<PetscInt> other(mesh.ownedNodes);
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node) other[node] = node;
  for (const auto& [node, layer] : all.layers) other[node] = layer, other[layer] = node;
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
                 rows = differences(mesh, all.layers);
  OwnedMat stiffness;
  check(MatPtAP(springs, rows, MAT_INITIAL_MATRIX, PETSC_DEFAULT, stiffness.out()));
  check(MatProductClear(stiffness));
  return stiffness;
}

}  // namespace squeal::interfaces
