// SPDX-License-Identifier: BSD-2-Clause
#include "regime/regime/static_responses.hpp"

#include <algorithm>

#include "base/system/termination.hpp"
#include "regime/regime/columns.hpp"

namespace squeal::regime {

using linalg::Block;
using linalg::DenseMatrix;

StaticResponses::StaticResponses(const FullModel& full, const std::vector<Node>& own)
    : full_(full),
      open_(full.contact.transformation(
          {contact::Mask(own.size(), 0), contact::Mask(own.size(), 1)})) {
  const std::vector<unsigned char> all(own.size(), 1);
  for (int a = 0; a + 1 < full.contact.mesh->dimension; ++a) {
    std::vector<contact::Slip> along(own.size());
    for (std::size_t i = 0; i < own.size(); ++i)
      along[i].direction = own[i].tangents[a], along[i].coefficient.fixed = 1;
    const OwnedMat rows = full.contact.slipRows(open_, along, all, 0);
    impedances_.push_back(std::make_unique<impedance::Impedance>(
        full.contact, open_, full.bodies.stiffness, rows, full.closed));
  }
}

Block StaticResponses::all(const std::vector<PetscInt>& order) const {
  const int dimension = full_.contact.mesh->dimension;
  PetscInt nodal = 0;
  check(MatGetLocalSize(open_.trial, &nodal, nullptr));
  Block result(nodal);
  result.reserve(std::ssize(order) * dimension);
  // Responses of one kind are computed together, since they share an operator.
  for (int c = 0; c < dimension; ++c) {
    const auto& impedance = *impedances_[std::max(0, c - 1)];
    for (std::size_t begin = 0; begin < order.size(); begin += blockColumns) {
      stopIfRequested(impedance.comm());
      const std::size_t count = std::min<std::size_t>(order.size() - begin, blockColumns);
      appendResponses(impedance, std::span(order).subspan(begin, count), c, result);
    }
  }
  return result;
}

/// Collective. Appends the responses in the row c of some nodes.
void StaticResponses::appendResponses(const impedance::Impedance& impedance,
                                      std::span<const PetscInt> nodes, int c, Block& result) const {
  PetscInt unknowns = 0;
  check(MatGetLocalSize(open_.trial, nullptr, &unknowns));
  DenseMatrix causes(impedance.length(), nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i] >= 0) causes(causeOf(impedance, nodes[i], c), i) = 1;
  Block x(unknowns, nodes.size());
  std::vector<OwnedVec> vectors;
  std::vector<Vec> borrowed;
  for (PetscInt j = 0; j < x.columns(); ++j) {
    vectors.push_back(borrowedVector(impedance.comm(), x.column(j)));
    borrowed.push_back(vectors.back());
  }
  impedance.addUnknowns(causes, borrowed);
  linalg::appendProduct(open_.trial, x, result);
}

/// Returns the row of the cause: a released unknown, or the friction of a node.
PetscInt StaticResponses::causeOf(const impedance::Impedance& impedance, PetscInt node,
                                  int c) const {
  const PetscInt nodes = impedance.nodes();
  if (c == 0) return nodes + node;
  const auto& nodeOf = impedance.nodeOf();
  int found = 0;
  for (std::size_t k = nodes; k < nodeOf.size(); ++k)
    if (nodeOf[k] == node && ++found == c) return nodes + k;
  return node;
}

}  // namespace squeal::regime
