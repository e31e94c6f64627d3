#pragma once
/// From matrices of files to eigenvalues: there is neither contact nor steady state [4.15].
#include <vector>

#include "analysis/analysis.hpp"
#include "matrices/matrices.hpp"
#include "sweep/sweep.hpp"

namespace squeal::analysis {

/// Collective. The matrices of files, checked against the sweep.
std::vector<matrices::NamedTerm> readMatrices(MPI_Comm comm, const sweep::Sweep& sweep);

/// Collective. Adds to the analysis the modes, and flutter at all points of its sweep.
void solveMatrices(Analysis& analysis);

}  // namespace squeal::analysis
