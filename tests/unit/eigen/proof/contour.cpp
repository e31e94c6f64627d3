// SPDX-License-Identifier: BSD-2-Clause
// The boundary of a region, and its top in a gap.
#include "eigen/proof/contour.hpp"

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace squeal;
using proof::Contour;

/// Returns the smallest distance of 20,000 points of each piece.
double sampled(const Contour& contour, Complex from) {
  constexpr int points = 20000;
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& piece : contour.pieces())
    for (int i = 0; i <= points; ++i)
      nearest = std::min(nearest, std::abs(from - piece.at(piece.length() * i / points)));
  return nearest;
}

TEST(Contour, DistancesAndReach) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-2, 2);
  for (const auto& contour : {Contour(1.1, 0.3, false), Contour(0.9, 5, false),
                              Contour(1.3, 1e-3, false), Contour(1.2, 0.1, true)})
    for (int i = 0; i < 50; ++i) {
      const Complex from(uniform(generator), uniform(generator));
      const double exact = contour.distance(from), found = sampled(contour, from);
      // Samples are 2e-4 apart at most: a nearest point between two is at most 1e-4 farther.
      EXPECT_LE(exact, found + 1e-12);
      EXPECT_GE(exact, found - 1.1e-4);
    }
  const Contour contour(1.1, 0.3, false);
  for (const auto& piece : contour.pieces()) {
    const double step = piece.parameter(0.2);
    EXPECT_NEAR(std::abs(piece.at(0.05) - piece.at(0.05 + step)), 0.2, 1e-12);
  }
}

// The pieces join the real axis at both ends, and their points are the edge of the region.
TEST(Contour, EnclosesTheRegion) {
  const Contour part(2, 0.5, false), disc(2, 2, false), square(4, 2, true);
  EXPECT_NEAR(std::abs(part.pieces()[0].at(part.pieces()[0].length()) - 2.0), 0, 1e-15);
  EXPECT_NEAR(std::abs(part.pieces()[2].at(part.pieces()[2].length()) + 0.5), 0, 1e-15);
  EXPECT_NEAR(std::abs(disc.pieces()[1].at(disc.pieces()[1].length()) + 2.0), 0, 1e-15);
  EXPECT_NEAR(std::abs(square.pieces()[0].at(square.pieces()[0].length()) - 4.0), 0, 1e-14);
  for (const auto& contour : {part, disc, square})
    for (const auto& piece : contour.pieces())
      for (const double t : {0.1, 0.4}) {
        const auto edge = piece.at(t * piece.length());
        EXPECT_NEAR(contour.distance(edge), 0, 1e-15);
        EXPECT_TRUE(contour.encloses(edge * 0.999));
        EXPECT_FALSE(contour.encloses(edge * 1.001));
      }
  EXPECT_FALSE(part.encloses({-0.51, 0}));
  EXPECT_TRUE(disc.encloses({-1.99, 0}));
  EXPECT_TRUE(square.encloses({-3.99, 0}));  // of z = s²: neutral eigenvalues
}

TEST(Contour, PlacesTheTopInTheWidestGap) {
  const std::vector<Complex> list{{0, 9.5}, {3, 9.539392014169456}, {-1, 9.9}, {0, -10.4}, {0, 20}};
  // |s| = 9.5, 9.950, 10 and 10.4 in [9.2, 10.8]
  EXPECT_NEAR(proof::placedTop(list, 10), 0.5 * (9.5 + std::sqrt(99.01)), 1e-12);
  // From 10.4 to the upper end.
  EXPECT_NEAR(proof::placedTop(list, 11), 0.5 * (10.4 + 11.88), 1e-12);
  EXPECT_DOUBLE_EQ(proof::placedTop({}, 10), 10);
  EXPECT_NEAR(proof::placedTop(list, 10, 0.02), 10.1, 1e-12);
}

TEST(Contour, PlacesTheLeftEdgeInTheWidestGap) {
  const std::vector<Complex> list{{-1, 5}, {-1.3, 9}, {-1.25, 12}, {2, 3}};
  // −Re s = 1 and 1.3 in [0.5, 1.5]; the third one is too far above the top.
  EXPECT_NEAR(proof::placedLeft(list, 10, 1), 0.75, 1e-12);
  EXPECT_NEAR(proof::placedLeft(list, 10, 1.15, 0.15), 1.15, 1e-3);
  EXPECT_NEAR(proof::placedLeft(list, 11, 1.15, 0.14), 1.125, 1e-12);
}

}  // namespace
