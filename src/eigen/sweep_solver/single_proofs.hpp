// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The proof that the list of a point is complete, whatever terms the problem of the point has.
#include <vector>

#include "eigen/modes/settings.hpp"
#include "eigen/reduction/reduced.hpp"
#include "eigen/sweep_solver/listed_point.hpp"
#include "eigen/sweep_solver/sweep_problem.hpp"

namespace squeal::sweep_solver {

/// Collective. Lets the referee judge the lists of these points, each with matrices, free modes and
/// a basis of its own; the basis contains the eigenvectors of the reduced problem. Sets
/// ComplexModes::completeness, and the radius of each eigenvalue that is proved. `discs` is the
/// largest number of expansions; `modes` are the settings of the free modes, whose number is not
/// used. Throws Interrupted between two points once a stop has been requested.
void proveSingly(const SweepProblem& problem, const reduction::ReducedProblem& reduced,
                 const std::vector<ListedPoint*>& points, int discs, modes::Settings modes);

}  // namespace squeal::sweep_solver
