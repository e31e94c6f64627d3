// SPDX-License-Identifier: BSD-2-Clause
// Changes of stability at frictions that are not known: each is listed once, within its step.
#include "eigen/stability/unlocated.hpp"

#include <gtest/gtest.h>

#include <tuple>

namespace squeal::test {
namespace {

using stability::TrackedLine;
using Kind = tracking::Event::Kind;

tracking::Station stationOf(double friction, const std::vector<Complex>& values,
                            std::size_t piece) {
  tracking::Station station{.friction = friction, .pairs = {}, .piece = piece};
  for (const Complex s : values) station.pairs.push_back({s, {}});
  station.inBand.assign(values.size(), 1);
  station.branch.assign(values.size(), 0);
  return station;
}

/// Stable at 0 and 0.1, unstable at 0.2 with another active set, stable again at 0.3, and with a
/// growing real eigenvalue at 0.4.
TrackedLine line() {
  TrackedLine line;
  line.isDamped = true;
  line.branches.stations = {
      stationOf(0, {{-1, 100}, {-1, 200}}, 0), stationOf(0.1, {{-1, 100}, {-1, 200}}, 0),
      stationOf(0.2, {{5, 110}, {8, 190}}, 1), stationOf(0.3, {{-5, 110}, {-1, 190}}, 1),
      stationOf(0.4, {{3, 0}, {-1, 190}}, 1)};
  return line;
}

TEST(UnlocatedChanges, AreListedInTheirSteps) {
  TrackedLine tracked = line();
  stability::addUnlocatedChanges(tracked);
  ASSERT_EQ(tracked.criticals.size(), 3U);
  ASSERT_EQ(tracked.criticalModes.size(), 3U);
  const double middle[] = {0.15, 0.25, 0.35}, frequency[] = {190, 190, 0};
  const Kind kind[] = {Kind::contact, Kind::crossing, Kind::divergence};
  const bool loss[] = {true, false, true};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& critical = tracked.criticals[i];
    EXPECT_DOUBLE_EQ(critical.friction, middle[i]);
    EXPECT_NEAR(critical.errorEstimate, 0.05, 1e-15);
    EXPECT_EQ(critical.angularFrequency, frequency[i]);
    EXPECT_EQ(critical.kind, kind[i]);
    EXPECT_EQ(critical.loss, loss[i]);
    EXPECT_FALSE(critical.converged);
    EXPECT_EQ(critical.partner, 0);
  }
}

// A known critical friction, or one known to lie in the step, explains the change.
TEST(UnlocatedChanges, AreNotListedTwice) {
  TrackedLine tracked = line();
  for (const auto& [friction, error, loss] :
       {std::tuple{0.12, 0., true}, {0.26, 1e-9, false}, {0.35, 0.05, true}}) {
    stability::Critical known;
    known.friction = friction;
    known.errorEstimate = error;
    known.loss = loss;
    tracked.criticals.push_back(known);
    tracked.criticalModes.emplace_back();
  }
  stability::addUnlocatedChanges(tracked);
  EXPECT_EQ(tracked.criticals.size(), 3U);
}

// A critical friction of the other direction explains nothing.
TEST(UnlocatedChanges, HaveADirection) {
  TrackedLine tracked = line();
  tracked.criticals.emplace_back().friction = 0.15;
  tracked.criticals.back().loss = false;
  tracked.criticalModes.emplace_back();
  stability::addUnlocatedChanges(tracked);
  EXPECT_EQ(tracked.criticals.size(), 4U);
}

// An unstable branch that enters the band from the guard zone has lost its stability elsewhere.
TEST(UnlocatedChanges, AreNoneAtTheEdgeOfTheBand) {
  TrackedLine tracked = line();
  auto& stations = tracked.branches.stations;
  stations.resize(3);
  for (auto& station : stations) station.branch = {1, 2};
  for (std::size_t k : {0, 1}) {
    stations[k].pairs.push_back({{8, 300}, {}});
    stations[k].inBand.push_back(0);
    stations[k].branch.push_back(3);
  }
  stations[2].pairs[0].s = {-1, 110};
  stations[2].branch[1] = 3;
  stability::addUnlocatedChanges(tracked);
  EXPECT_TRUE(tracked.criticals.empty());
}

// Below the first friction of a line without an earlier one, another active set applies.
TEST(UnlocatedChanges, BeginWhereTheLineDoes) {
  TrackedLine tracked = line();
  tracked.from = 0.25;
  stability::addUnlocatedChanges(tracked);
  ASSERT_EQ(tracked.criticals.size(), 1U);
  EXPECT_DOUBLE_EQ(tracked.criticals[0].friction, 0.35);
}

TEST(UnlocatedChanges, AreNamedByTheStatement) {
  TrackedLine tracked = line();
  tracked.unlocated.emplace_back(0.1, 0.2);
  EXPECT_NE(tracked.statement().find("between friction 0.1 and 0.2, where the active set changes"),
            std::string::npos);
}

}  // namespace
}  // namespace squeal::test
