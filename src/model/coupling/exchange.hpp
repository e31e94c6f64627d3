// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Combines the values of several ranks at the same nodes.
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::coupling {

/// Combines values at nodes. A periodic image and its primary are treated as one node.
class NodeExchange {
 public:
  /// Collective.
  explicit NodeExchange(const mesh::Mesh& mesh);
  /// Returns the local number of a global node of this rank's cells.
  PetscInt local(PetscInt globalNode) const;
  /// Returns the global number of the primary of a local node, or of the node itself if it is not
  /// an image.
  PetscInt primary(PetscInt localNode) const { return primary_[localNode]; }
  /// Collective. Replaces the values, [local node], by the sums over all ranks and images.
  void sum(std::vector<double>& values) const { combine(values, ADD_VALUES); }
  /// Collective. Replaces the values, [local node], which must not be negative, by the largest ones
  /// over all ranks and images.
  void largest(std::vector<double>& values) const { combine(values, MAX_VALUES); }

 private:
  void combine(std::vector<double>& values, InsertMode mode) const;
  void connect();
  const mesh::Mesh& mesh_;
  std::vector<PetscInt> primary_;  // [local node]
  OwnedVec global_, local_;        // a value per node
  OwnedScatter scatter_;           // from global_ to local_
};

}  // namespace squeal::coupling
