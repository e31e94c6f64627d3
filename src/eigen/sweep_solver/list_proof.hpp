// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The proof that the lists of eigenvalues of a sweep are complete.
#include <string>
#include <vector>

#include "eigen/modes/modes.hpp"
#include "eigen/reduction/reduced.hpp"
#include "eigen/sweep_solver/listed_point.hpp"
#include "eigen/sweep_solver/single_proofs.hpp"
#include "eigen/sweep_solver/sweep_problem.hpp"

namespace squeal::sweep_solver {

/// Collective. Sets ComplexModes::completeness of the points that do not have it yet, and extends
/// the basis for this purpose. `modes` are the free modes of the interior unknowns. Does nothing
/// without a basis of `-flutter_basis corrected`, or if this basis spans the whole space.
void proveLists(const SweepProblem& problem, reduction::ReducedProblem& reduced,
                const modes::Modes& modes, std::vector<ListedPoint> points,
                const ProofRequest& request);

/// Not collective. Returns what is wrong with the list of a point: a line of text for missing and
/// one for spurious eigenvalues. None if nothing is known to be wrong.
std::vector<std::string> faultsOf(const pencil::ComplexModes& point);

/// Not collective. Returns true if the list of a point has a fault, or if an eigenvalue of the
/// reduced problem in the band is undecided: the list lacks one of several equal eigenvalues, or
/// one at the edge of the band. `band` gives the largest damping ratio of listed eigenvalues; its
/// top is not used.
bool mayLackEigenvalues(const pencil::ComplexModes& point, pencil::WatchedBand band);

}  // namespace squeal::sweep_solver
