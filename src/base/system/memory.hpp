// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Free memory, and the report of a lack of memory. Functions are collective only if marked so.
#include <mpi.h>

namespace squeal {

/// Advice for messages on lack of memory.
inline constexpr const char* lessMemory =
    "use more nodes, a coarser mesh, or fewer free modes; a dry run estimates the memory of a run";

/// Returns the memory available to this process, in bytes: the free memory of the machine or, if it
/// is less, of the control group.
double availableMemory();

/// Returns the size of the address space of this process, in bytes.
double addressSpace();

/// Collective. Returns the free memory of this rank's node, in bytes. Replaces `needed`, the memory
/// that this rank needs, by the sum over all ranks of the node.
double memoryFreeOnNode(MPI_Comm comm, double& needed);

/// Makes the C library retain some of the freed memory. The program allocates and frees many blocks
/// of columns, and the kernel would clear their pages each time (1/40 of the time of a run).
void retainFreedMemory();

/// Reports in one line that this rank is out of memory, and ends all ranks.
[[noreturn]] void outOfMemory();

}  // namespace squeal
