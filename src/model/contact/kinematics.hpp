// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The kinematics u = A z of contact, with a normal and tangents at each contact node.
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/contact/active_set.hpp"
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::contact {

using mesh::Point;

struct Kinematics {
  OwnedMat matrix;     ///< A, N×N
  OwnedVec offset;     ///< u0, N entries, m: held displacements and displacements of obstacles
  OwnedVec gapOffset;  ///< u_g, N entries, m: closes the initial gaps, and shortens bolts
  /// [owned node · dimension + component of z] 1 if it is an unknown; 1 for all gaps
  std::vector<unsigned char> free;
};

/// Returns the row of z and of N that belongs to the gap of a contact node.
PetscInt gapRow(const mesh::Mesh& mesh, const interfaces::ContactNode& node);

/// Returns the number of blocks in each block row, [owned node], of a matrix that connects the
/// slaves of this level with themselves and with their masters. It is at least one. Level 0 means
/// the contact nodes of all levels.
std::vector<PetscInt> blocksOfRows(const mesh::Mesh& mesh, const interfaces::Interfaces& all,
                                   int level);

/// Collective. Returns the kinematics, with periodicity P and the gap basis E. Throws Error on all
/// ranks for a held component that is not tangential at a contact node, and for any held component
/// at a sticking node.
Kinematics kinematicsOf(const mesh::Mesh& mesh, const interfaces::Interfaces& all, Mat periodic);

}  // namespace squeal::contact
