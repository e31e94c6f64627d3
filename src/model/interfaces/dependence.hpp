// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The rows of the change of variables u = A z (see contact::Contact) at nodes with turned axes and
/// at followers, which are nodes that follow others through ties and couplings.
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

/// Returns the level of each follower, [owned node]; 0 for all other nodes.
std::vector<int> levelsOfFollowers(const mesh::Mesh& mesh, const Interfaces& all);

/// Adds to `blocks`, [owned node], the number of blocks that the rows of the followers of this
/// level need.
void countBlocks(const Interfaces& all, int level, std::vector<PetscInt>& blocks);

/// Not collective. Sets the rows of the followers of this level.
void setFollowers(const mesh::Mesh& mesh, const Interfaces& all, int level, Mat rows);

/// Collective. Returns the matrix Qᵀ of u = Qᵀ z, N×N, which turns the axes of nodes whose supports
/// are not along x, y, z. Its rows are those of the identity at all other nodes, and at contact
/// nodes and followers.
OwnedMat turnedAxes(const mesh::Mesh& mesh, const Interfaces& all);

/// Collective. Returns an N×N matrix with the rows of the followers of this level. The rows of all
/// other nodes are those of the identity.
OwnedMat rowsOfLevel(const mesh::Mesh& mesh, const Interfaces& all, int level);

/// Collective. Returns the matrix A, N×N, of all ties, couplings and turned axes, without
/// equations. The rows of contact nodes are those of the identity.
OwnedMat followedRows(const mesh::Mesh& mesh, const Interfaces& all);

/// Collective. Throws Error, naming coupling, interface and position, for a coupled node that is
/// also the slave of an interface or a periodic image.
void rejectTwoMasters(const mesh::Mesh& mesh, const Interfaces& all);

}  // namespace squeal::interfaces
