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
/// the basis for this purpose. `modes` are the free modes of the interior unknowns. Returns a line
/// of text for each list that lacks an eigenvalue or has a wrong one. Does nothing without a basis
/// of `-flutter_basis corrected`, or if this basis spans the whole space.
std::vector<std::string> proveLists(const SweepProblem& problem, reduction::ReducedProblem& reduced,
                                    const modes::Modes& modes, std::vector<ListedPoint> points,
                                    const ProofRequest& request);

}  // namespace squeal::sweep_solver
