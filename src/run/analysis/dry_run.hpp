// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The option `-dry_run` says what a run would do and take, without a solution and without results.
#include <mpi.h>

#include "run/analysis/settings.hpp"

namespace squeal::analysis {

/// Collective. Checks the input, after the options, as a run does up to its first factorisation,
/// and says what was found: bodies, constraints, loads, contact (or matrices), points of the sweep,
/// and an estimate of the memory. Whether matrices from files are symmetric and positive definite
/// is not checked. Throws Error as the run does.
void dryRun(MPI_Comm comm, const Settings& settings);

}  // namespace squeal::analysis
