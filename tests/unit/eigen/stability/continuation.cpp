// SPDX-License-Identifier: BSD-2-Clause
// Branches that two bases share at one friction are joined there by their eigenvalues.
#include "eigen/stability/continuation.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace squeal::test {
namespace {

using stability::TrackedLine;
using tracking::Station;

/// Returns a station of eigenvalues in the band, with the numbers of their branches.
Station stationOf(double friction, const std::vector<Complex>& values, std::vector<int> branches,
                  std::size_t piece = 0) {
  Station station{.friction = friction, .pairs = {}, .branch = std::move(branches), .piece = piece};
  for (const Complex s : values) station.pairs.push_back({s, {}});
  station.overlap.assign(values.size(), 1);
  station.inBand.assign(values.size(), 1);
  return station;
}

/// Returns a line that continues another at its first station.
TrackedLine lineOf(std::vector<Station> stations, int count, std::vector<int> sets) {
  TrackedLine line;
  line.begin = stations.front().friction;
  line.continues = true;
  line.branches.stations = std::move(stations);
  line.branches.count = count;
  line.activeSet = std::move(sets);
  return line;
}

void addCritical(TrackedLine& line, double friction, int branch, int partner, std::size_t piece) {
  stability::Critical critical;
  critical.friction = friction;
  critical.branch = branch;
  critical.partner = partner;
  critical.piece = piece;
  line.criticals.push_back(critical);
  pencil::CriticalMode mode;
  mode.name = std::to_string(friction);
  line.criticalModes.push_back(mode);
}

/// Three branches up to friction 0.2; the lowest two change places on the way.
TrackedLine first() {
  TrackedLine line = lineOf({stationOf(0, {{0, 100}, {0, 200}, {0, 300}}, {1, 2, 3}),
                             stationOf(0.2, {{0, 150}, {0, 151}, {0, 310}}, {2, 1, 3}, 1)},
                            3, {1, 2});
  addCritical(line, 0.1, 3, 0, 0);
  line.countExact = true;
  return line;
}

TEST(Continuation, BranchesKeepTheirNumbers) {
  TrackedLine line = first();
  // The numbers of the second basis are by frequency at its first station; errors of 1e-8.
  TrackedLine next = lineOf({stationOf(0.2, {{0, 150.000001}, {0, 151}, {0, 310}}, {1, 2, 3}),
                             stationOf(0.3, {{0, 140}, {0, 320}, {0, 400}}, {1, 3, 4}, 2)},
                            4, {2, 0, 3});
  next.branches.entered = 1;
  next.branches.left = 1;
  addCritical(next, 0.25, 2, 3, 1);
  stability::append(line, std::move(next));
  const auto& stations = line.branches.stations;
  ASSERT_EQ(stations.size(), 3U);  // the shared one only once
  EXPECT_EQ(stations[1].branch, (std::vector<int>{2, 1, 3}));
  EXPECT_EQ(stations[2].branch, (std::vector<int>{2, 3, 4}));
  EXPECT_EQ(line.branches.count, 4);
  EXPECT_EQ(line.activeSet, (std::vector<int>{1, 2, 0, 3}));
  EXPECT_EQ(line.activeSet[stations[2].piece], 3);
  ASSERT_EQ(line.criticals.size(), 2U);
  EXPECT_EQ(line.criticals[1].branch, 1);
  EXPECT_EQ(line.criticals[1].partner, 3);
  EXPECT_EQ(line.activeSet[line.criticals[1].piece], 0);
  EXPECT_EQ(line.criticalModes.size(), 2U);
  EXPECT_TRUE(line.complete()) << line.statement();
  EXPECT_TRUE(line.branches.gaps.empty());
  EXPECT_EQ(line.branches.inBandAt(stations.back()),
            line.branches.inBandAt(stations.front()) + line.branches.entered - line.branches.left);
}

// Where the bands of the two bases differ, eigenvalues enter and leave at the shared friction.
TEST(Continuation, BandsMayDiffer) {
  TrackedLine line = first();
  line.branches.stations[1].inBand = {1, 1, 0};
  line.branches.left = 1;
  TrackedLine next = lineOf({stationOf(0.2, {{0, 150}, {0, 151}, {0, 310}, {0, 330}}, {1, 2, 3, 0}),
                             stationOf(0.3, {{0, 150}, {0, 151}, {0, 310}}, {1, 2, 3})},
                            3, {2});
  next.branches.stations[0].inBand[3] = 0;
  stability::append(line, std::move(next));
  EXPECT_TRUE(line.branches.gaps.empty());
  EXPECT_EQ(line.branches.entered, 1);
  EXPECT_EQ(line.branches.left, 1);
  EXPECT_EQ(line.branches.stations.back().branch, (std::vector<int>{2, 1, 3}));
}

TEST(Continuation, DifferencesAreNamed) {
  {
    TrackedLine line = first();  // 310 is missing, 290 is new
    stability::append(line,
                      lineOf({stationOf(0.2, {{0, 150}, {0, 151}, {0, 290}}, {1, 2, 3})}, 3, {2}));
    ASSERT_EQ(line.branches.gaps.size(), 1U);
    EXPECT_FALSE(line.complete());
    EXPECT_EQ(line.branches.gaps[0].from, 0.2);
    EXPECT_NE(line.statement().find("1 are only in the first, 1 only in the second, and 0 are "
                                    "unstable in one of them"),
              std::string::npos)
        << line.statement();
    EXPECT_EQ(line.branches.count, 4);
  }
  for (const bool damped : {false, true}) {  // it grows in the second basis only, by 1e-8 of |s|
    TrackedLine line = first();
    TrackedLine next =
        lineOf({stationOf(0.2, {{3e-6, 150}, {0, 151}, {0, 310}}, {1, 2, 3})}, 3, {2});
    next.isDamped = damped;
    stability::append(line, std::move(next));
    EXPECT_EQ(line.complete(), !damped) << line.statement();  // round-off in a problem in s²
  }
}

// Outside the band of one basis, which is not corrected there, the same eigenvalue is less
// accurate.
TEST(Continuation, GuardZonesAreLessAccurate) {
  for (const bool inBand : {false, true}) {
    TrackedLine line = first();
    line.branches.stations[1].inBand[2] = inBand;
    stability::append(line, lineOf({stationOf(0.2, {{0, 150}, {0, 151}, {0, 310.03}}, {1, 2, 3}),
                                    stationOf(0.3, {{0, 150}, {0, 151}, {0, 310}}, {1, 2, 3})},
                                   3, {2}));
    EXPECT_EQ(line.complete(), !inBand);  // a relative difference of 1e-4
    EXPECT_EQ(line.branches.stations.back().branch[2], inBand ? 4 : 3);
  }
  // Above the top of the other band, an eigenvalue has entered.
  TrackedLine line = first();
  line.branches.band.top = 320;
  stability::append(
      line,
      lineOf({stationOf(0.2, {{0, 150}, {0, 151}, {0, 310}, {0, 450}}, {1, 2, 3, 4})}, 4, {2}));
  EXPECT_TRUE(line.complete()) << line.statement();
  EXPECT_EQ(line.branches.entered, 1);
}

// Equal eigenvalues differ only by round-off, which may be in any order: the lowest number
// continues the lowest number.
TEST(Continuation, EqualEigenvaluesContinueByNumber) {
  TrackedLine line = first();
  line.branches.stations[1] = stationOf(0.2, {{0, 150}, {0, 150 + 1e-11}, {0, 310}}, {2, 1, 3}, 1);
  stability::append(
      line, lineOf({stationOf(0.2, {{0, 150 + 2e-12}, {0, 150 + 9e-12}, {0, 310}}, {1, 2, 3}),
                    stationOf(0.3, {{0, 140}, {0, 160}, {0, 310}}, {1, 2, 3})},
                   3, {2}));
  EXPECT_EQ(line.branches.stations.back().branch, (std::vector<int>{1, 2, 3}));
  EXPECT_TRUE(line.branches.gaps.empty());
}

// Two eigenvalues closer to each other than to those of the other basis cannot be distinguished.
// Equal ones need not be.
TEST(Continuation, CloseEigenvaluesAreNamed) {
  for (const double apart : {1e-6, 1e-12}) {
    TrackedLine line = first();
    line.branches.stations[1].pairs[1].s = {0, 150 + 150 * apart};
    TrackedLine next = lineOf(
        {stationOf(0.2, {{0, 150 + 300 * apart}, {0, 150 + 450 * apart}, {0, 310}}, {1, 2, 3})}, 3,
        {2});
    stability::append(line, std::move(next));
    EXPECT_TRUE(line.complete());
    EXPECT_EQ(line.branches.gaps.size(), apart > 1e-7 ? 1U : 0U);
    EXPECT_EQ(line.branches.count, 3);
  }
}

// A line that continues no other is tracked from friction 0 with an active set that does not apply
// there. What it has below its first swept friction is omitted, even if one of its stations is at
// the last friction of the other line. Its branches are new, and the part in between is a gap,
// also where there is already one in the identity of eigenvalues.
TEST(Continuation, SeparateLinesKeepTheirBranchesApart) {
  for (const double from : {0.0, 0.4}) {  // 0.4: it also has a gap from the other line
    TrackedLine line = first();
    TrackedLine next =
        lineOf({stationOf(0, {{0, 100}, {0, 200}, {0, 300}}, {1, 2, 3}),
                stationOf(0.2, {{0, 150}}, {1}), stationOf(0.4, {{0, 150}, {0, 200}}, {1, 2}),
                stationOf(0.5, {{0, 150}, {0, 200}}, {2, 1})},
               3, {5});
    next.begin = 0.4;
    next.from = from;
    next.continues = false;
    next.branches.entered = 7;
    next.branches.gaps.push_back({0, 0.4, "two cannot be distinguished", true});
    if (from > 0) next.branches.gaps.push_back({0.2, 0.4, "no basis"});
    addCritical(next, 0.15, 1, 2, 0);
    addCritical(next, 0.3, 1, 2, 0);
    addCritical(next, 0.45, 2, 0, 0);
    stability::append(line, std::move(next));
    const auto& stations = line.branches.stations;
    ASSERT_EQ(stations.size(), 4U);
    EXPECT_EQ(stations[2].friction, 0.4);
    EXPECT_EQ(stations[2].branch, (std::vector<int>{4, 5}));
    EXPECT_EQ(stations[3].branch, (std::vector<int>{5, 4}));
    EXPECT_EQ(line.branches.count, 5);
    EXPECT_EQ(line.branches.entered, 0);
    EXPECT_EQ(std::ranges::count(line.branches.gaps, false, &tracking::Gap::identityOnly), 1);
    const auto gap = std::ranges::find(line.branches.gaps, false, &tracking::Gap::identityOnly);
    EXPECT_EQ(gap->from, 0.2);
    EXPECT_EQ(gap->to, 0.4);
    EXPECT_FALSE(line.complete());
    ASSERT_EQ(line.criticals.size(), 2U);
    EXPECT_EQ(line.criticals[1].friction, 0.45);
    EXPECT_EQ(line.criticals[1].branch, 5);
    EXPECT_EQ(line.criticals[1].partner, 0);
    EXPECT_EQ(line.criticalModes[1].name, std::to_string(0.45));
    EXPECT_EQ(line.activeSet[line.criticals[1].piece], 5);
  }
}

// The line that it was to continue has no result: what is missing is named.
TEST(Continuation, AMissingStartIsNamed) {
  TrackedLine line = lineOf({stationOf(0.2, {{0, 150}}, {1})}, 1, {2});
  stability::nameMissingStart(line);
  ASSERT_EQ(line.branches.gaps.size(), 1U);
  EXPECT_EQ(line.branches.gaps[0].from, 0);
  EXPECT_EQ(line.branches.gaps[0].to, 0.2);
  EXPECT_FALSE(line.complete());
  TrackedLine zero = lineOf({stationOf(0, {{0, 150}}, {1})}, 1, {2});
  stability::nameMissingStart(zero);
  EXPECT_TRUE(zero.complete());
  TrackedLine other = first();
  other.continues = false;
  stability::nameMissingStart(other);
  EXPECT_TRUE(other.complete());
}

TEST(Continuation, AMissingEndIsNamed) {
  TrackedLine line = first();
  stability::nameMissingEnd(line, 0.6);
  EXPECT_TRUE(line.complete());
  line.isContinued = true;
  stability::nameMissingEnd(line, 0.2);
  EXPECT_TRUE(line.complete());
  stability::nameMissingEnd(line, 0.6);
  ASSERT_EQ(line.branches.gaps.size(), 1U);
  EXPECT_EQ(line.branches.gaps[0].from, 0.2);
  EXPECT_EQ(line.branches.gaps[0].to, 0.6);
}

TEST(Continuation, ALineWithoutResultsIsReplaced) {
  TrackedLine line;
  line.branches.gaps.push_back({0, 0, "no reduced problem"});
  stability::append(line, first());
  EXPECT_EQ(line.branches.stations.size(), 2U);
  EXPECT_EQ(line.branches.gaps.size(), 1U);
  EXPECT_EQ(line.criticals.size(), 1U);
}

}  // namespace
}  // namespace squeal::test
