// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The free modes of active sets that share a basis.
#include <vector>

#include "eigen/modes/modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/reduction/reduced.hpp"
#include "eigen/sweep_solver/sweep_problem.hpp"

namespace squeal::sweep_solver {

/// Collective. Returns the free modes of each range, [range], as vectors of all unknowns; none for
/// a range without points. `interior` are the modes of the interior unknowns, and numbers[range] is
/// the index of its set in the reduced problem. Only K and M of `pencil` are used.
std::vector<modes::Modes> modesOfSets(reduction::ReducedProblem& reduced,
                                      const pencil::Pencil& pencil, const SweepProblem& problem,
                                      const modes::Modes& interior,
                                      const std::vector<int>& numbers);

}  // namespace squeal::sweep_solver
