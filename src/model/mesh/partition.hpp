// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Division of the cells among the ranks. For rank 0 only.
#include <vector>

#include "model/mesh/whole.hpp"

namespace squeal::mesh {

/// Returns the rank of each cell, [cell]. METIS partitions the dual graph of the cells so that the
/// ranks get nearly equal shares of the nodes and of the faces on surfaces. Contact partners are
/// treated as one node, and so are periodic images and their primaries. Throws Error for more ranks
/// than cells.
std::vector<int> partition(const WholeMesh& mesh, int ranks);

}  // namespace squeal::mesh
