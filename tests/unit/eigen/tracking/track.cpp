// SPDX-License-Identifier: BSD-2-Clause
// Eigenvalues of small dense families followed over the friction: their number and their order.
#include "eigen/tracking/track.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "eigen/pencil/band.hpp"
#include "eigen/stability/critical.hpp"
#include "eigen/tracking/renumber.hpp"
#include "support/eigen/friction_families.hpp"

namespace squeal {
namespace {

using test::crossingModes;
using test::expectNoGaps;
using test::grid;
using test::Linear;
using test::modal;
using test::randomFamily;

// Modes that cross without seeing each other keep their vectors: branch k has the frequency of mode
// k throughout.
TEST(Track, UncoupledModesKeepTheirIdentity) {
  Linear family = crossingModes({100, 110, 121, 150}, {60, 20, 0, -50}, {});
  for (const int steps : {1, 4, 10}) {
    const auto branches = track(family, grid(1, steps), {});
    expectNoGaps(branches);
    EXPECT_TRUE(branches.events.empty());
    EXPECT_EQ(branches.count, 4);
    for (const auto& station : branches.stations)
      for (std::size_t i = 0; i < 4; ++i) {
        const int mode = station.branch[i];
        const double exact =
            family.base.stiffness(mode, mode) + station.friction * family.friction(mode, mode);
        EXPECT_NEAR(std::norm(station.pairs[i].s), exact, 1e-10 * exact);
      }
  }
}

// Two modes are equal at f = 0, except for simulated round-off: it makes them a split pair, or
// puts one of them or the other first. Their frequencies part from there, and so number 1 is the
// one that falls, whatever rounding says.
TEST(Track, EqualEigenvaluesAreNumberedByWhereTheyPart) {
  const double square = 100, rounding = 1e-10;
  for (const auto& [first, second, skew] : {std::tuple{rounding, -rounding, 0.0},
                                            {-rounding, rounding, 0.0},
                                            {0.0, 0.0, rounding},
                                            {0.0, 0.0, -rounding},
                                            {0.0, 0.0, 0.0}})
    for (const bool falls : {false, true}) {
      Linear family = crossingModes({square + first, square + second, 400},
                                    {falls ? -10.0 : 20.0, falls ? 20.0 : -10.0, 0}, {});
      family.base.stiffness(1, 0) = skew;
      family.base.stiffness(0, 1) = -skew;
      auto branches = track(family, grid(1, 4), {});
      renumber(branches);
      EXPECT_EQ(branches.count, 3);
      for (const auto& station : branches.stations)
        for (std::size_t i = 0; i < 3; ++i) {
          const double exact =
              std::vector{square - 10 * station.friction, square + 20 * station.friction,
                          400.0}[station.branch[i] - 1];
          EXPECT_NEAR(std::norm(station.pairs[i].s), exact, 10 * rounding)
              << "friction " << station.friction << ", rounding " << first << " " << second << " "
              << skew;
        }
    }
}

// s² + 20 s + 36 − 40 f has the roots −10 ± √(64 + 40 f): −2 passes through zero at f = 0.9 and
// into the band, −18 stays out of it, and so do the modes beside them of damping ratio 0.9. Not
// followed from the start, the first is found where it comes near zero.
TEST(Track, StronglyDampedOnesAreLeftAloneUntilTheyMatter) {
  Linear family = modal({100, 36, 49, 64}, {{1, 1, -40}}, {0.2, 20, 12.6, 14.4});
  pencil::WatchedBand band;
  band.top = 15;
  const auto branches = track(family, grid(1, 5), band);
  const auto found = stability::criticalFrictions(family, branches, 1e-9);
  expectNoGaps(branches);
  EXPECT_EQ(branches.stations.front().pairs.size(), 1u);  // −2 is farther from zero than 1.5
  EXPECT_EQ(branches.stations.back().pairs.size(), 2u);
  EXPECT_EQ(branches.count, 2);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, tracking::Event::Kind::divergence);
  EXPECT_TRUE(found[0].loss);
  EXPECT_NEAR(found[0].friction, 0.9, 1e-10);
  EXPECT_NEAR(found[0].slope, 2, 1e-5);  // ds/df = 20 / √(64 + 40 f), by a difference
}

// Eigenvalues enter and leave only by the edge of the band.
TEST(Track, TheEdgeOfTheBand) {
  Linear family = randomFamily(30, 7, false);
  pencil::WatchedBand band;
  band.top = 1540;
  const auto branches = track(family, grid(1, 8), band);
  expectNoGaps(branches);
  const auto& first = branches.stations.front();
  const auto& last = branches.stations.back();
  EXPECT_EQ(branches.inBandAt(last), branches.inBandAt(first) + branches.entered - branches.left);
  for (const auto& station : branches.stations)
    for (std::size_t i = 0; i < station.pairs.size(); ++i) {
      EXPECT_TRUE(!station.inBand[i] || &station == &first || station.overlap[i] > 0.5);
    }
}

// A path of 200 pieces. Two modes of ω² = 100 and 140 with the coupling c are a split pair if
// c > (140 − 100)/2, that is from each odd change to the next one.
struct ManyPieces {
  static constexpr int pieces = 200;
  std::vector<Linear> families;
  std::vector<tracking::Piece> path;

  explicit ManyPieces(const std::vector<int>& changes, bool affine) {
    families.reserve(pieces);
    for (int k = 0; k < pieces; ++k) {
      const auto passed = std::ranges::count_if(changes, [&](int change) { return change <= k; });
      Linear family = modal({100, 140, 400}, {});
      family.affine = affine;
      family.base.stiffness(0, 1) = passed % 2 == 1 ? 25 : 10;
      family.base.stiffness(1, 0) = -family.base.stiffness(0, 1);
      families.push_back(std::move(family));
      path.push_back({&families.back(), {1. * k / pieces, (k + 1.) / pieces}, {0, 0}});
    }
    for (const int swept : {0, 60, 120}) path[swept].needed[0] = 1;
  }
};

void expectChanges(const tracking::Branches& branches, const std::vector<int>& changes) {
  constexpr int pieces = ManyPieces::pieces;
  expectNoGaps(branches);
  EXPECT_EQ(branches.count, 3);
  std::vector<double> found;
  for (const auto& event : branches.events) {
    EXPECT_EQ(event.kind, tracking::Event::Kind::contact);
    EXPECT_EQ(event.low, event.high);
    if (found.empty() || found.back() != event.low) found.push_back(event.low);
    EXPECT_EQ(event.piece, std::lround(event.low * pieces));
  }
  ASSERT_EQ(found.size(), changes.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k], 1. * changes[k] / pieces);
}

// If all pieces are examined, no change goes unnoticed: not one that is undone in the next piece,
// nor those that lie between two points of the sweep with the same stability.
TEST(Track, AllPiecesOfAnAffinePathAreExamined) {
  const std::vector<int> changes{5, 6, 41, 90, 137};
  ManyPieces many(changes, true);
  const auto branches = track(many.path, {});
  expectChanges(branches, changes);
  EXPECT_EQ(branches.omitted, 0);
}

// Where each problem takes a steady state, few pieces are examined until each change of stability
// lies at the end of the piece where it happens.
TEST(Track, AnExpensivePathIsBisected) {
  const std::vector<int> changes{41, 90, 137};
  ManyPieces many(changes, false);
  const auto branches = track(many.path, {});
  expectChanges(branches, changes);
  // Each change takes log2 of its 120 or 160 places, and one more.
  EXPECT_LE(branches.stations.size(), 4U + 3 * 9);
  EXPECT_GT(branches.omitted, ManyPieces::pieces / 2);
}

}  // namespace
}  // namespace squeal
