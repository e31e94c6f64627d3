// SPDX-License-Identifier: BSD-2-Clause
// What the journal of a sweep records, a later run finds at the same places.
#include "eigen/sweep_solver/journal.hpp"

#include <gtest/gtest.h>

#include "problem/terms/terms.hpp"
#include "support/algebra/sparse.hpp"
#include "support/eigen/bare_problem.hpp"
#include "support/harness/scratch_folder.hpp"
#include "support/problem/coarse_layers.hpp"

namespace squeal::test {
namespace {

using checkpoint::Checkpoint;
using sweep_solver::Journal;
using sweep_solver::SweepState;

/// A sweep of two active sets in the unknowns of two layers.
struct Sweep {
  Layers layers{"-modes_count 6"};
  BareProblem problem;
  sweep_solver::SweepPlan plan;
  Folder folder;
  Sweep() {
    problem.system = layers.system.get();
    problem.pencil.emplace(terms::affineTerms(layers.model.contact, *layers.system));
    for (int i = 0; i < 4; ++i) problem.steadyPoints.push_back({0.1 * i});
    problem.ranges.push_back({.first = 0, .last = 3});
    problem.ranges.push_back({.first = 3, .last = 4});
    plan = sweep_solver::planOf(problem, {1}, true);
  }
  Checkpoint opened(bool resume) const {
    return {PETSC_COMM_WORLD,
            folder.path / "interrupted" / "checkpoint",
            {{"a", "1"}},
            {.interval = 0, .resume = resume}};
  }
  /// Returns a state without points, with places for them.
  SweepState empty() const {
    SweepState state;
    for (const std::size_t count : {3, 1}) {
      state.segments.emplace_back();
      state.segments.back().points.resize(count);
    }
    return state;
  }
  /// Solves the next `count` points of the plan: their eigenvalues are their friction and number.
  void solve(SweepState& state, std::size_t count) const {
    for (; count > 0; --count, ++state.solved) {
      const std::size_t i = plan.order[state.solved];
      const auto& place = plan.places[i];
      auto& point = state.segments[place.range].points[place.inRange];
      point.at = plan.points[i];
      point.eigenvalues = {{.s = {plan.points[i].friction, double(i)}, .error = 0.5}};
    }
  }
};

/// Expects the first `count` points of the plan at their places, and no others.
void expectSolved(const Sweep& sweep, const SweepState& state, std::size_t count) {
  EXPECT_EQ(state.solved, count);
  for (std::size_t k = 0; k < sweep.plan.order.size(); ++k) {
    const std::size_t i = sweep.plan.order[k];
    const auto& place = sweep.plan.places[i];
    const auto& point = state.segments[place.range].points[place.inRange];
    ASSERT_EQ(point.eigenvalues.size(), k < count ? 1U : 0U);
    if (k >= count) continue;
    EXPECT_EQ(point.at, sweep.plan.points[i]);
    EXPECT_EQ(point.eigenvalues[0].s, Complex(0.1 * i, double(i)));
    EXPECT_EQ(point.eigenvalues[0].error, 0.5);
  }
}

// Two entries, of two points and of one; the fourth point has not been recorded. The modes come
// back with the entries of their vectors.
TEST(Journal, RestoresWhatItHasRecorded) {
  const Sweep sweep;
  SweepState state = sweep.empty();
  modes::Modes free = sweep.layers.modes();
  Checkpoint first = sweep.opened(false);
  Journal writer(first, "sweep", sweep.problem, sweep.plan, state);
  EXPECT_FALSE(writer.restoreFinished());
  EXPECT_FALSE(writer.restoredModes());
  for (const std::size_t count : {2, 1}) {
    sweep.solve(state, count);
    state.failures.push_back("a point");
    state.affine = false;
    writer.record(free, nullptr);
  }
  sweep.solve(state, 1);

  Checkpoint second = sweep.opened(true);
  SweepState restored = sweep.empty();
  Journal reader(second, "sweep", sweep.problem, sweep.plan, restored);
  EXPECT_FALSE(reader.restoreFinished());
  const auto modes = reader.restoredModes();
  ASSERT_TRUE(modes);
  EXPECT_EQ(modes->angularFrequency, free.angularFrequency);
  for (PetscInt j = 0; j < 6; ++j) {
    Vec there = nullptr, here = nullptr;
    check(BVGetColumn(free.vectors, j, &there));
    check(BVGetColumn(modes->vectors, j, &here));
    EXPECT_EQ(allEntries(here), allEntries(there));
    check(BVRestoreColumn(free.vectors, j, &there));
    check(BVRestoreColumn(modes->vectors, j, &here));
  }
  reader.restorePoints(nullptr);
  expectSolved(sweep, restored, 3);
  EXPECT_EQ(restored.failures, (std::vector<std::string>{"a point", "a point"}));
  EXPECT_FALSE(restored.affine);

  // The run that has resumed adds the rest.
  sweep.solve(restored, 1);
  reader.record(free, nullptr);
  Checkpoint third = sweep.opened(true);
  SweepState again = sweep.empty();
  Journal last(third, "sweep", sweep.problem, sweep.plan, again);
  last.restorePoints(nullptr);
  expectSolved(sweep, again, 4);
}

// A proof of a point that was solved once more comes back with the new list and all else.
TEST(Journal, RestoresPointsThatWereSolvedAgain) {
  const Sweep sweep;
  SweepState state = sweep.empty();
  modes::Modes free = sweep.layers.modes();
  Checkpoint first = sweep.opened(false);
  Journal writer(first, "sweep", sweep.problem, sweep.plan, state);
  sweep.solve(state, 4);
  const auto prove = [](pencil::ComplexModes& point, int count) {
    point.completeness.emplace().count = count;
  };
  auto& points = state.segments[0].points;
  writer.record(free, nullptr);
  for (auto& point : points) prove(point, 2);
  writer.record(free, nullptr);
  points[1].eigenvalues.push_back({.s = {0, 7}, .error = 0.25});
  points[1].bandTop = 8;
  writer.replace({1});
  prove(points[1], 4);
  writer.record(free, nullptr);

  Checkpoint second = sweep.opened(true);
  SweepState restored = sweep.empty();
  Journal reader(second, "sweep", sweep.problem, sweep.plan, restored);
  (void)reader.restoredModes();
  reader.restorePoints(nullptr);
  const auto& found = restored.segments[0].points;
  EXPECT_EQ(found[0].completeness->count, 2);
  EXPECT_EQ(found[0].eigenvalues.size(), 1U);
  EXPECT_EQ(found[1].completeness->count, 4);
  ASSERT_EQ(found[1].eigenvalues.size(), 2U);
  EXPECT_EQ(found[1].eigenvalues[1].s, Complex(0, 7));
  EXPECT_EQ(found[1].bandTop, 8);
  EXPECT_FALSE(restored.segments[1].points[0].completeness);
}

// A sweep that is finished comes back without its parts, under its own name only.
TEST(Journal, RestoresFinishedSegments) {
  const Sweep sweep;
  SweepState state = sweep.empty();
  sweep.solve(state, 4);
  state.segments[1].openNodes = 3;
  state.segments[1].unknowns = 150;
  state.segments[0].solves = 7;
  stability::Critical critical;
  critical.friction = 0.15;
  state.segments[0].trackedLines.emplace_back().criticals.push_back(critical);
  Checkpoint first = sweep.opened(false);
  Journal(first, "one", sweep.problem, sweep.plan, state).recordFinished();

  Checkpoint second = sweep.opened(true);
  SweepState restored;
  EXPECT_FALSE(Journal(second, "other", sweep.problem, sweep.plan, restored).restoreFinished());
  EXPECT_TRUE(Journal(second, "one", sweep.problem, sweep.plan, restored).restoreFinished());
  ASSERT_EQ(restored.segments.size(), 2U);
  restored.solved = 4;  // a number of the parts, not of the whole
  expectSolved(sweep, restored, 4);
  EXPECT_EQ(restored.segments[1].openNodes, 3);
  EXPECT_EQ(restored.segments[1].unknowns, 150);
  EXPECT_EQ(restored.segments[0].solves, 7);
  ASSERT_EQ(restored.segments[0].trackedLines.size(), 1U);
  EXPECT_EQ(restored.segments[0].trackedLines[0].criticals.at(0).friction, 0.15);
}

}  // namespace
}  // namespace squeal::test
