// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Free memory, and the report of a lack of memory. Functions are collective only if marked so.
#include <mpi.h>

namespace squeal {

/// Advice for messages on lack of memory.
inline constexpr const char* lessMemory =
    "use more nodes, a coarser mesh, or fewer free modes; a dry run estimates the memory of a run";

/// Collective. Returns the free memory of this rank's node, in bytes. Replaces `needed`, the memory
/// that this rank needs, by the sum over all ranks of the node.
double memoryFreeOnNode(MPI_Comm comm, double& needed);

/// Reports in one line that this rank is out of memory, and ends all ranks.
[[noreturn]] void outOfMemory();

}  // namespace squeal
