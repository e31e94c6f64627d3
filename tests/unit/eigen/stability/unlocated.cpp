// SPDX-License-Identifier: BSD-2-Clause
// Changes of stability at frictions that are not known: each is listed once, within its step.
#include "eigen/stability/unlocated.hpp"

#include <gtest/gtest.h>

namespace squeal::test {
namespace {

using stability::TrackedLine;
using Kind = tracking::Event::Kind;

tracking::Station stationOf(double friction, const std::vector<Complex>& values,
                            std::size_t piece) {
  tracking::Station station{.friction = friction, .pairs = {}, .piece = piece};
  for (const Complex s : values) station.pairs.push_back({s, {}});
  station.inBand.assign(values.size(), 1);
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
  }
}

// A known critical friction, or one known to lie in the step, explains the change.
TEST(UnlocatedChanges, AreNotListedTwice) {
  TrackedLine tracked = line();
  for (const auto& [friction, error] : {std::pair{0.12, 0.}, {0.26, 1e-9}, {0.35, 0.05}}) {
    stability::Critical known;
    known.friction = friction;
    known.errorEstimate = error;
    tracked.criticals.push_back(known);
    tracked.criticalModes.emplace_back();
  }
  stability::addUnlocatedChanges(tracked);
  EXPECT_EQ(tracked.criticals.size(), 3U);
}

// The active set changes between 0.1 and 0.2. A jump whose friction is known has a station of both
// pieces there.
TEST(DirectJumps, LieBetweenStationsOfDifferentPieces) {
  TrackedLine tracked = line();
  const auto jumps = stability::directJumps(tracked.branches);
  ASSERT_EQ(jumps.size(), 1U);
  EXPECT_EQ(jumps[0], std::pair(0.1, 0.2));
  EXPECT_NE(tracked.statement().find("between friction 0.1 and 0.2, where the active set changes"),
            std::string::npos);
  tracked.branches.stations.insert(
      tracked.branches.stations.begin() + 2,
      {stationOf(0.15, {{-1, 100}}, 0), stationOf(0.15, {{5, 110}}, 1)});
  EXPECT_TRUE(stability::directJumps(tracked.branches).empty());
}

}  // namespace
}  // namespace squeal::test
