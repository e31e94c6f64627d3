// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Eigenvalues of matrices from files, without contact or steady states [4.15].
#include <vector>

#include "base/checkpoint/checkpoint.hpp"
#include "eigen/sweep/sweep.hpp"
#include "eigen/sweep_solver/sweep_solver.hpp"
#include "problem/matrices/matrices.hpp"
#include "run/analysis/flutter.hpp"
#include "run/analysis/settings.hpp"

namespace squeal::analysis {

/// Collective. Reads the matrices from files and checks them against the sweep. Throws Error as
/// matrices::readTerms(), rejectIdleFactors() and requireFiniteSweep() do.
std::vector<matrices::NamedTerm> readMatrices(MPI_Comm comm, const Settings& settings,
                                              const sweep::Sweep& sweep);

/// Collective. Returns one segment with the eigenvalues at all points of the sweep. Throws Error as
/// readMatrices(), matrices::symmetricPart() and the stages do.
Flutter matrixFlutter(MPI_Comm comm, const Settings& settings, const sweep::Sweep& sweep,
                      const sweep_solver::Request& request, checkpoint::Checkpoint& checkpoint);

}  // namespace squeal::analysis
