// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The contact nodes of the mesh as nodes of the reduced model.
#include <mpi.h>

#include <vector>

#include "algebra/linalg/dense.hpp"
#include "base/system/concatenation.hpp"
#include "model/contact/contact.hpp"
#include "regime/march/model.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::regime {

using march::Node;

/// Collective. Returns the contact nodes of this rank with their steady state.
std::vector<Node> ownNodes(const contact::Contact& contact, const steady::Solution& solution);

/// Collective. Returns the jumps at the contact nodes of this rank, node by node, for the nodal
/// displacements u. Throws Interrupted once a stop of the run has been requested.
linalg::DenseMatrix ownJumps(const contact::Contact& contact, const std::vector<Node>& nodes,
                             const linalg::DenseView& u);

/// The contact nodes of all ranks in an order that does not depend on the number of ranks: by
/// interface, then by position.
class Order {
 public:
  /// Collective.
  Order(MPI_Comm comm, const std::vector<Node>& own);
  const std::vector<Node>& nodes() const { return nodes_; }
  /// Returns the index of each node among the nodes of this rank; −1 for a node of another rank.
  const std::vector<PetscInt>& own() const { return own_; }
  /// Collective. Returns the rows of all nodes in this order. `own` has `perNode` rows for each
  /// node of this rank.
  linalg::DenseMatrix gathered(const linalg::DenseView& own, PetscInt perNode) const;

 private:
  MPI_Comm comm_;
  Concatenation ranks_;
  std::vector<Node> nodes_;
  std::vector<PetscInt> place_, own_;
};

}  // namespace squeal::regime
