// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The option `-dry_run`: checks the input and estimates the memory of a run, without a solution or
/// results.
#include <mpi.h>

#include "run/analysis/settings.hpp"

namespace squeal::analysis {

/// Collective. Checks the input as a run does up to its first factorisation, and prints what it
/// found: bodies, constraints, loads, contact (or matrices), the points of the sweep, an estimate
/// of the memory, and the audit of the model. It does not check whether matrices from files are
/// symmetric and positive definite. Throws Error as the run does.
void dryRun(MPI_Comm comm, const Settings& settings);

}  // namespace squeal::analysis
