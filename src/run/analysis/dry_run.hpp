// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The option `-dry_run`: a check of the input, and estimates of memory and time of a run. Nothing
/// is solved and no results are written.
#include <mpi.h>

#include "run/analysis/settings.hpp"

namespace squeal::analysis {

/// Collective. Checks the input as a run does up to its first factorisation. Prints the bodies,
/// constraints, loads and contact (or the matrices), the points of the sweep, estimates of memory
/// and time (cost.hpp), and the audit of the model. Does not check whether matrices from files are
/// symmetric and positive definite. Throws Error as the run does.
void dryRun(MPI_Comm comm, const Settings& settings);

}  // namespace squeal::analysis
