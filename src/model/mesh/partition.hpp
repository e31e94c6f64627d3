#pragma once
/// This function divides the cells among the ranks. It is for rank 0 only.
#include <vector>

#include "model/mesh/whole.hpp"

namespace squeal::mesh {

/// Returns the rank of each cell, [cell], which METIS finds from the dual graph. Contact partners,
/// and periodic images with their primaries, count as one node. Throws Error for more ranks than
/// cells.
std::vector<int> partition(const WholeMesh& mesh, int ranks);

}  // namespace squeal::mesh
