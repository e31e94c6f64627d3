// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The rows of u = A z at nodes that follow others through ties and couplings, and at nodes with
/// turned axes.
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

/// Returns the level of each owned node that follows others through a tie or a coupling, [owned
/// node]; 0 for all others.
std::vector<int> levelsOfFollowers(const mesh::Mesh& mesh, const Interfaces& all);

/// Adds the number of blocks, [owned node], that the rows of the followers of this level need.
void countBlocks(const Interfaces& all, int level, std::vector<PetscInt>& blocks);

/// Not collective. Sets the rows of the followers of this level.
void setFollowers(const mesh::Mesh& mesh, const Interfaces& all, int level, Mat rows);

/// Collective. Returns the rows that turn the axes of nodes with supports in other directions,
/// u = Qᵀ z, N×N; the identity at all other nodes, and at contact nodes and followers.
OwnedMat turnedAxes(const mesh::Mesh& mesh, const Interfaces& all);

/// Collective. Returns the rows of the followers of this level, N×N; those of all other nodes are
/// rows of the identity.
OwnedMat rowsOfLevel(const mesh::Mesh& mesh, const Interfaces& all, int level);

/// Collective. Returns u = A z of all ties, couplings and turned axes, N×N, before equations. Rows
/// of contact nodes are those of the identity.
OwnedMat followedRows(const mesh::Mesh& mesh, const Interfaces& all);

/// Collective. Throws Error, naming coupling, interface and position, for a coupled node that is
/// also the slave of an interface or a periodic image.
void rejectTwoMasters(const mesh::Mesh& mesh, const Interfaces& all);

}  // namespace squeal::interfaces
