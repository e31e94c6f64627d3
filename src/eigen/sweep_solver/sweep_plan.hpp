// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The points of a sweep, and the order in which they are solved.
#include <vector>

#include "eigen/sweep/parameters.hpp"
#include "eigen/sweep_solver/sweep_problem.hpp"

namespace squeal::sweep_solver {

/// The place of a point of the sweep.
struct PointPlace {
  std::size_t steadyPoint;  ///< index in SweepProblem::steadyPoints
  std::size_t range;        ///< index in SweepProblem::ranges
  std::size_t inRange;      ///< index among all points of the range
  bool isOwn = true;        ///< false: a point of the preceding problem, without results here
};

/// The points of all dampings at all steady points.
struct SweepPlan {
  std::vector<sweep::Parameters> points;
  std::vector<PointPlace> places;                 ///< [point]
  std::vector<std::vector<std::size_t>> batches;  ///< points that are solved together, in order
  std::vector<std::size_t> order;                 ///< all points, batch after batch
  /// Returns how many of order[first], …, order[last - 1] have results here.
  std::size_t own(std::size_t first, std::size_t last) const;
};

/// Returns the plan of a sweep. With `together`, the points of a batch share the corrections of one
/// basis. Without it, each point is a batch.
SweepPlan planOf(const SweepProblem& problem, const std::vector<double>& dampings, bool together);

}  // namespace squeal::sweep_solver
