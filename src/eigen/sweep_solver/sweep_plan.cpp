// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep_solver/sweep_plan.hpp"

#include <algorithm>

#include "eigen/sweep/sweep.hpp"

namespace squeal::sweep_solver {

std::size_t SweepPlan::own(std::size_t first, std::size_t last) const {
  return std::count_if(order.begin() + first, order.begin() + last,
                       [&](std::size_t i) { return places[i].isOwn; });
}

SweepPlan planOf(const SweepProblem& problem, const std::vector<double>& dampings, bool together) {
  SweepPlan plan;
  std::vector<std::size_t> counts(problem.ranges.size(), 0);
  for (double damping : dampings)
    for (std::size_t i = 0; i < problem.steadyPoints.size(); ++i) {
      plan.points.push_back(problem.steadyPoints[i]);
      plan.points.back().damping = damping;
      const auto range = std::ranges::find_if(
          problem.ranges, [&](const auto& one) { return one.first <= i && i < one.last; });
      const std::size_t number = range - problem.ranges.begin();
      plan.places.push_back({i, number, counts[number]++, i > 0 || !problem.continues});
    }
  plan.batches = sweep::batches(plan.points);
  for (const auto& batch : plan.batches)
    plan.order.insert(plan.order.end(), batch.begin(), batch.end());
  if (together) return plan;
  plan.batches.clear();
  for (const std::size_t i : plan.order) plan.batches.push_back({i});
  return plan;
}

}  // namespace squeal::sweep_solver
