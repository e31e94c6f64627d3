// SPDX-License-Identifier: BSD-2-Clause
// The points of a sweep over several active sets, and their order.
#include "eigen/sweep_solver/sweep_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/eigen/bare_problem.hpp"

namespace squeal::test {
namespace {

using sweep_solver::SweepPlan;

std::vector<std::size_t> inOrder(std::vector<std::size_t> list) {
  std::ranges::sort(list);
  return list;
}

/// Frictions 0, 0.1, …, 0.6; the first five steady points have one active set, none has the next,
/// and the last two have the third.
struct Problem : BareProblem {
  Problem() {
    for (int i = 0; i < 7; ++i) steadyPoints.push_back({0.1 * i, 2});
    ranges.push_back({.first = 0, .last = 5});
    ranges.push_back({.first = 5, .last = 5});
    ranges.push_back({.first = 5, .last = 7});
  }
};

// A point for each damping and steady state; within its range it is counted over all dampings.
TEST(SweepPlan, PlacesAllPoints) {
  const Problem sweep;
  const SweepPlan plan = sweep_solver::planOf(sweep, {0.5, 3}, true);
  ASSERT_EQ(plan.points.size(), 14U);
  for (std::size_t i = 0; i < 14; ++i) {
    const std::size_t steady = i % 7, second = i / 7;
    EXPECT_EQ(plan.points[i], (sweep::Parameters{0.1 * steady, 2, 1, second ? 3. : 0.5}));
    EXPECT_EQ(plan.places[i].steadyPoint, steady);
    EXPECT_EQ(plan.places[i].range, steady < 5 ? 0U : 2U);
    EXPECT_EQ(plan.places[i].inRange, steady < 5 ? steady + 5 * second : steady - 5 + 2 * second);
  }
}

// Five points, then the rest. The first has the largest friction, the second is the farthest from
// it: the other end of both ranges.
TEST(SweepPlan, SolvesEachPointOnce) {
  const Problem sweep;
  const SweepPlan plan = sweep_solver::planOf(sweep, {0.5, 3}, true);
  ASSERT_EQ(plan.batches.size(), 2U);
  EXPECT_EQ(plan.batches[0].size(), 5U);
  EXPECT_EQ(plan.order[0], 6U);
  EXPECT_EQ(plan.order[1], 7U);
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < 14; ++i) all.push_back(i);
  EXPECT_EQ(inOrder(plan.order), all);
  std::vector<std::size_t> joined = plan.batches[0];
  joined.insert(joined.end(), plan.batches[1].begin(), plan.batches[1].end());
  EXPECT_EQ(joined, plan.order);
}

// Points that share nothing are batches of their own, in the same order.
TEST(SweepPlan, KeepsTheOrderOfSinglePoints) {
  const Problem sweep;
  const SweepPlan together = sweep_solver::planOf(sweep, {1}, true),
                  single = sweep_solver::planOf(sweep, {1}, false);
  EXPECT_EQ(single.order, together.order);
  ASSERT_EQ(single.batches.size(), 7U);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(single.batches[i], std::vector{single.order[i]});
}

}  // namespace
}  // namespace squeal::test
