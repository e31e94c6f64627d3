// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The trial functions T, and the common unknowns of two active sets.
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/contact/active_set.hpp"
#include "model/contact/kinematics.hpp"
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::contact {

/// The trial functions T for one choice of the gaps that are unknowns.
struct Transformation {
  OwnedMat selection;  ///< B, N×n
  OwnedMat trial;      ///< T = A B, N×n
  /// [contact node] global column of its gap; −1 if the gap is not an unknown
  std::vector<PetscInt> gapColumn;
  PetscInt ownedColumns = 0, columns = 0;  ///< columns of this rank, and of all ranks (n)
  /// [unknown of this rank] its local row of B, ascending: dimension · owned node + component of z
  std::vector<PetscInt> rows;
};

/// This rank's unknowns of a system with open contact: those that it shares with the system with
/// closed contact, and the others. Both lists ascend and number the unknowns of the rank from 0.
struct ReleasedUnknowns {
  std::vector<PetscInt> shared, released;
};

/// Divides the unknowns of `open`, which include those of `closed`, into shared and released ones.
ReleasedUnknowns compared(const Transformation& open, const Transformation& closed);

/// Collective. Returns T, which excludes the gaps of closed contact nodes from the unknowns. A node
/// of a sticking interface does not move along its master unless it is released. No node is
/// released if the mask of released nodes is empty.
Transformation transformationOf(const mesh::Mesh& mesh, const interfaces::Interfaces& all,
                                const Kinematics& kinematics, const ActiveSet& set);

}  // namespace squeal::contact
