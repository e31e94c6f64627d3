#pragma once
/// `-dry_run`: what a run would do and take, without a solution and without results.
#include <mpi.h>

namespace squeal::analysis {

bool dryRunWanted();

/// Collective. Checks the input as a run does up to its first solution, after the options, and says
/// what was found: bodies, constraints, loads, contact (or matrices), points of the sweep, and an
/// estimate of the memory. Errors as those of the run.
void dryRun(MPI_Comm comm);

}  // namespace squeal::analysis
