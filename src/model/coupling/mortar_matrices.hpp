// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The matrices of a coupling, from sums over its faces.
#include <vector>

#include "model/coupling/sums.hpp"

namespace squeal::coupling {

/// The pivots of this rank, and the factors W/D of the jumps at all local nodes. The factors are
/// zero at nodes that are not pivots.
struct Pivoting {
  std::vector<PetscInt> owned;  ///< local nodes, ascending
  std::vector<double> ratio;    ///< [local node]
};

/// Returns the pivots, that is, the slave nodes with a condition. Not collective.
Pivoting pivotsOf(const mesh::Mesh& mesh, const NodeExchange& exchange, const SlaveBasis& basis,
                  const Sums& sums);

/// The matrices of one coupling. They have a row for each node, which is empty unless the node is a
/// pivot.
struct Matrices {
  OwnedMat masters, jumps, jumpsOf, convected;  ///< P, G, G⁻¹, rows of SlaveNode::convected
  OwnedMat parts, bodies;                       ///< shares, one column per part or body
  std::vector<Point> offsets;                   ///< SlaveNode::offset, [pivot of this rank]
};

/// Collective. Returns the matrices, and consumes the triples of the sums.
Matrices matricesOf(const mesh::Mesh& mesh, const NodeExchange& exchange,
                    const std::vector<CoveredFace>& faces, const SlaveBasis& basis,
                    const Pivoting& pivoting, Sums& sums);

}  // namespace squeal::coupling
