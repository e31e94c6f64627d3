// SPDX-License-Identifier: BSD-2-Clause
// The verdict of a run, from eigenvalues made by hand.
#include "run/report/verdict.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace squeal::test {
namespace {

using pencil::Eigenvalue;
using pencil::Verdict;

Eigenvalue stable(double hertz) {
  return {.s = {-1, 2 * M_PI * hertz}, .certified = true, .verdict = Verdict::stable};
}
Eigenvalue growing(double hertz, double rate) {
  return {.s = {rate, 2 * M_PI * hertz},
          .certified = true,
          .verdict = Verdict::unstable,
          .unstable = true};
}
Eigenvalue undecided(double hertz) {
  return {.s = {1e-9, 2 * M_PI * hertz}, .certified = true, .verdict = Verdict::undecided};
}

pencil::ComplexModes point(const sweep::Parameters& at, std::vector<Eigenvalue> eigenvalues) {
  pencil::ComplexModes modes;
  modes.at = at;
  modes.eigenvalues = std::move(eigenvalues);
  return modes;
}

/// Returns a run over these frictions, and no points.
analysis::Analysis over(const std::vector<double>& frictions, const std::vector<double>& speeds) {
  analysis::Analysis analysis;
  analysis.sweep = {frictions, speeds, {1}, {1}};
  analysis.flutter.segments.emplace_back();
  return analysis;
}

void addCritical(analysis::Analysis& analysis, double friction, bool loss, bool converged) {
  stability::Critical critical;
  critical.friction = friction;
  critical.loss = loss;
  critical.converged = converged;
  analysis.flutter.segments.back().trackedLines.emplace_back().criticals.push_back(critical);
}

TEST(RunVerdict, OfStablePoints) {
  analysis::Analysis one = over({0.4}, {1});
  auto& points = one.flutter.segments[0].points;
  EXPECT_EQ(report::runVerdict(one).sentence, "No point of the sweep has a steady sliding state.");
  points.push_back(point({0.4}, {}));
  EXPECT_EQ(report::runVerdict(one).sentence,
            "No eigenvalue was found in the band at friction 0.4.");
  points[0].eigenvalues = {stable(100), undecided(200), undecided(300)};
  const report::RunVerdict verdict = report::runVerdict(one);
  EXPECT_EQ(verdict.sentence, "Stable at friction 0.4; 2 eigenvalues are undecided.");
  EXPECT_EQ(verdict.points, 1);
  EXPECT_EQ(verdict.pointsSolved, 1);
  EXPECT_EQ(verdict.pointsUnstable, 0);
  EXPECT_EQ(verdict.undecided, 2);
  EXPECT_EQ(verdict.uncertified, 0);
  EXPECT_FALSE(verdict.criticalFriction);

  analysis::Analysis several = over({0, 0.2, 0.4}, {1});
  for (const double friction : {0., 0.2})
    several.flutter.segments[0].points.push_back(point({friction}, {stable(100)}));
  EXPECT_EQ(report::runVerdict(several).sentence,
            "Stable at the 2 of 3 points of the sweep that have a result.");
  several.flutter.segments.emplace_back().points.push_back(
      point({0.4}, {stable(100), Eigenvalue{}}));
  EXPECT_EQ(report::runVerdict(several).sentence,
            "Stable at all points of the sweep; 1 eigenvalue is uncertified.");
  EXPECT_EQ(report::runVerdict(several).uncertified, 1);
}

// An empty list says nothing, unless it is proved to be complete.
TEST(RunVerdict, EmptyListIsNoStability) {
  analysis::Analysis run = over({0, 0.2, 0.4}, {1});
  auto& points = run.flutter.segments[0].points;
  points.push_back(point({0.}, {stable(100)}));
  points.push_back(point({0.2}, {}));
  points.push_back(point({0.4}, {}));
  EXPECT_EQ(report::runVerdict(run).sentence,
            "Stable at the 1 of 3 points of the sweep with a known stability; 2 points have no "
            "eigenvalue in the band, so their stability is unknown.");
  EXPECT_EQ(report::runVerdict(run).pointsUnknown, 2);
  for (std::size_t i : {1, 2}) points[i].completeness.emplace().proved = true;
  ASSERT_TRUE(points[1].listIsProved());
  EXPECT_EQ(report::runVerdict(run).sentence, "Stable at all points of the sweep.");
}

/// Frictions 0, 0.2, 0.4, of which the last two have unstable modes, the fastest at 1000 Hz with 20
/// 1/s: a damping ratio of −20/|s|, −0.318 %.
analysis::Analysis unstableFrom(double lowest) {
  analysis::Analysis run = over({lowest, lowest + 0.2, lowest + 0.4}, {1});
  auto& points = run.flutter.segments[0].points;
  points.push_back(point({lowest}, {stable(500), stable(1000)}));
  points.push_back(point({lowest + 0.2}, {stable(500), growing(1000, 10)}));
  points.push_back(point({lowest + 0.4}, {growing(500, 5), growing(1000, 20), stable(2000)}));
  return run;
}
const std::string fastest =
    "; above it, up to 2 unstable modes at once. The fastest-growing one, at 1000 Hz, has a growth "
    "rate of 20 1/s (damping -0.318 %) at friction ";

TEST(RunVerdict, OfUnstablePoints) {
  analysis::Analysis run = unstableFrom(0);
  const report::RunVerdict verdict = report::runVerdict(run);
  EXPECT_EQ(verdict.sentence, "Unstable from friction 0.2 on" + fastest + "0.4.");
  EXPECT_EQ(verdict.pointsUnstable, 2);
  EXPECT_EQ(verdict.mostUnstable, 2);
  run.flutter.segments[0].points[0].eigenvalues.push_back(growing(3000, 1));
  EXPECT_EQ(report::runVerdict(run).sentence, "Unstable at friction 0 already" + fastest + "0.4.");
}

// The lowest friction of a loss, if it has settled and no unstable point lies below it.
TEST(RunVerdict, NamesTheFirstLoss) {
  analysis::Analysis run = unstableFrom(0);
  addCritical(run, 0.01, false, true);  // regained
  addCritical(run, 0.15, true, false);  // not settled
  addCritical(run, 0.3, true, true);
  EXPECT_FALSE(report::runVerdict(run).criticalFriction);  // 0.2 is unstable
  addCritical(run, 0.1234567, true, true);
  EXPECT_EQ(report::runVerdict(run).criticalFriction, 0.1234567);
  EXPECT_EQ(report::runVerdict(run).sentence, "Stable up to friction 0.123457" + fastest + "0.4.");
  addCritical(run, 0, true, true);
  EXPECT_EQ(report::runVerdict(run).sentence,
            "Unstable as soon as there is friction" + fastest + "0.4.");
}

// A loss between 0.05 and 0.1 leaves open which one is the first.
TEST(RunVerdict, NamesNoLossAboveAnUnsettledOne) {
  analysis::Analysis run = unstableFrom(0);
  addCritical(run, 0.1234567, true, true);
  addCritical(run, 0.075, true, false);
  run.flutter.segments.back().trackedLines.back().criticals.back().errorEstimate = 0.025;
  EXPECT_FALSE(report::runVerdict(run).criticalFriction);
  EXPECT_EQ(report::runVerdict(run).sentence, "Unstable from friction 0.2 on" + fastest + "0.4.");
}

// With two swept parameters there is no single critical friction, and the fastest mode is placed by
// both.
TEST(RunVerdict, OfTwoSweptParameters) {
  analysis::Analysis run = over({0.2, 0.4}, {1, 2});
  addCritical(run, 0.1, true, true);
  for (const double speed : {1., 2.})
    for (const double friction : {0.2, 0.4})
      run.flutter.segments[0].points.push_back(
          point({friction, speed}, {growing(1000, friction < 0.3 && speed > 1 ? 20 : 1)}));
  const report::RunVerdict verdict = report::runVerdict(run);
  EXPECT_FALSE(verdict.criticalFriction);
  EXPECT_EQ(verdict.points, 4);
  EXPECT_EQ(
      verdict.sentence,
      "Unstable at friction 0.2 already; above it, up to 1 unstable mode at once. The "
      "fastest-growing one, at 1000 Hz, has a growth rate of 20 1/s (damping -0.318 %) at friction "
      "0.2, speed 2.");
}

TEST(RunVerdict, OfAnInterruptedRun) {
  analysis::Analysis run = unstableFrom(0);
  run.flutter.complete = false;
  run.flutter.segments[0].points.pop_back();
  EXPECT_EQ(report::runVerdict(run).sentence,
            "The run was stopped before its end: 2 of 3 points are solved, and the lowest friction "
            "among them with an unstable mode is 0.2.");
  run.flutter.segments[0].points.pop_back();
  EXPECT_EQ(report::runVerdict(run).sentence,
            "The run was stopped before its end: 1 of 3 points are solved, and all of them are "
            "stable.");
}

}  // namespace
}  // namespace squeal::test
