#pragma once
/// How much memory there is, and what is said where there is too little.
#include <petscsys.h>

namespace squeal {

/// What to try, for messages.
inline constexpr const char* lessMemory =
    "take more nodes, a coarser mesh, or fewer free modes; a dry run estimates what a run takes";

/// What is free for this process, in bytes: of the machine, or of its control group where that has
/// less.
double availableMemory();

/// The addresses that this process holds, in bytes.
double addressSpace();

/// Collective. What is free on this rank's node, in bytes. `needed`, in: by this rank, out: by all
/// ranks of the node.
double memoryFreeOnNode(MPI_Comm comm, double& needed);

/// PETSc prints no trace of an allocation that fails from here on.
void tellLackOfMemoryInOneLine();

/// The error `code` of a PETSc call means that an allocation has failed.
bool lacksMemory(PetscErrorCode code);

/// OpenBLAS asks for its workspace for ever if it does not get it. It gets it here, once and for
/// all calls of this thread, or the run ends.
void claimBlasWorkspace();

/// Says in one line that this rank has got no memory, and ends all ranks.
[[noreturn]] void outOfMemory();

}  // namespace squeal
