// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The change of variables that carries contact, with all gaps unknown and all nodes sliding.
#include <vector>

#include "model/contact/contact.hpp"
#include "model/contact/coupled.hpp"
#include "model/mesh/mesh.hpp"
#include "support/harness/ranks.hpp"
#include "support/model/model.hpp"

namespace squeal::test {

/// The part of a contact node that the tests need, on whatever rank it is.
struct Node {
  mesh::Point position, normal, slip;
  double slipSpeed, area;
  PetscInt pad, master, gapColumn;  // global
};

/// Collective. `gapColumn`: the unknown of the gap of each node of this rank.
inline std::vector<Node> allNodes(const contact::Contact& contact,
                                  const std::vector<PetscInt>& gapColumn) {
  constexpr int width = 14;
  std::vector<double> mine;
  for (std::size_t i = 0; i < contact.interfaces.nodes.size(); ++i) {
    const auto& node = contact.interfaces.nodes[i];
    for (const mesh::Point& p : {node.position, node.normal, node.slip})
      mine.insert(mine.end(), p.begin(), p.end());
    mine.insert(mine.end(), {node.slipSpeed, node.area, double(node.globalNode),
                             double(node.master), double(gapColumn[i])});
  }
  const auto all = gathered(mine, MPI_DOUBLE);
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < all.size(); i += width)
    nodes.push_back({{all[i], all[i + 1], all[i + 2]},
                     {all[i + 3], all[i + 4], all[i + 5]},
                     {all[i + 6], all[i + 7], all[i + 8]},
                     all[i + 9],
                     all[i + 10],
                     static_cast<PetscInt>(all[i + 11]),
                     static_cast<PetscInt>(all[i + 12]),
                     static_cast<PetscInt>(all[i + 13])});
  return nodes;
}

/// The components at a node, of a list of those at all nodes.
inline mesh::Point at(const std::vector<double>& u, PetscInt node, int dimension) {
  mesh::Point p{};
  for (int d = 0; d < dimension; ++d) p[d] = u[dimension * node + d];
  return p;
}

inline mesh::Point minus(const mesh::Point& a, const mesh::Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// E = Nᵀ S, N×n, of L(f) = T + f E.
inline OwnedMat frictionTest(const contact::Contact& contact,
                             const contact::Transformation& transformation,
                             const std::vector<unsigned char>& slides) {
  const OwnedMat rows = contact.slipRows(transformation, contact.slip(1, nullptr), slides, 1);
  OwnedMat result;
  check(MatTransposeMatMult(contact.sliding.reaction, rows, MAT_INITIAL_MATRIX, PETSC_DEFAULT,
                            result.out()));
  return result;
}

/// Contact that couples disc and pad: a model and its change of variables.
struct Coupled {
  Model model;
  contact::Transformation transformation;
  OwnedMat friction;
  std::vector<Node> nodes;
  int dimension() const { return model.mesh->dimension; }
  mesh::Point jump(const std::vector<double>& u, const Node& node) const {
    return minus(at(u, node.pad, dimension()),
                 node.master >= 0 ? at(u, node.master, dimension()) : mesh::Point{});
  }
};

/// Collective. All gaps unknown, all nodes sliding, from the options in force.
inline Coupled coupled() {
  Coupled c{buildModel(), {}, {}, {}};
  const std::vector<unsigned char> all(c.model.contact.interfaces.nodes.size(), 1);
  c.transformation = c.model.contact.transformation(contact::ActiveSet::open(all.size()));
  c.friction = frictionTest(c.model.contact, c.transformation, all);
  c.nodes = allNodes(c.model.contact, c.transformation.gapColumn);
  return c;
}

}  // namespace squeal::test
