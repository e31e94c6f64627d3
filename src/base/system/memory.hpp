#pragma once
/// These functions find the free memory, and report where there is too little. Only those that say
/// so are collective.
#include <mpi.h>

namespace squeal {

/// Advice for messages on lack of memory.
inline constexpr const char* lessMemory =
    "take more nodes, a coarser mesh, or fewer free modes; a dry run estimates what a run takes";

/// Returns the memory that is free for this process, in bytes: that of the machine, or that of its
/// control group where that is less.
double availableMemory();

/// Returns the size of the address space of this process, in bytes.
double addressSpace();

/// Collective. Returns the free memory of this rank's node, in bytes. `needed`, the memory that
/// this rank needs, becomes the sum over all ranks of the node.
double memoryFreeOnNode(MPI_Comm comm, double& needed);

/// Makes the C library keep some of the memory that is freed. Blocks of columns come and go, and
/// the kernel would clear their pages each time, which took a fortieth of a run.
void keepFreedMemory();

/// Prints in one line that this rank has no memory, and ends all ranks.
[[noreturn]] void outOfMemory();

}  // namespace squeal
