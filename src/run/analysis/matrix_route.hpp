// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// This route leads from matrices of files to eigenvalues; there is neither contact nor steady
/// state [4.15].
#include <vector>

#include "eigen/sweep/sweep.hpp"
#include "problem/matrices/matrices.hpp"
#include "run/analysis/analysis.hpp"

namespace squeal::analysis {

/// Collective. Returns the matrices of files, checked against the sweep. Throws Error as
/// matrices::readTerms(), rejectIdleFactors() and requireFiniteSweep() do.
std::vector<matrices::NamedTerm> readMatrices(MPI_Comm comm, const Settings& settings,
                                              const sweep::Sweep& sweep);

/// Collective. Adds to the analysis one segment: the modes, and flutter at all points of its sweep.
/// Throws Error as readMatrices(), matrices::symmetricPart() and the stages do.
void solveMatrices(Analysis& analysis);

}  // namespace squeal::analysis
