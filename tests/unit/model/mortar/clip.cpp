// SPDX-License-Identifier: BSD-2-Clause
// Cutting of convex polygons and segments against exact areas, and the rules of integration.
#include "model/mortar/clip.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "support/algebra/dense.hpp"

namespace squeal {
namespace {

using namespace mortar;

Region rectangle(double x0, double x1, double y0, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

Region regular(int corners, double radius, double angle) {
  Region region;
  for (int i = 0; i < corners; ++i) {
    const double at = angle + 2 * std::numbers::pi * i / corners;
    region.push_back({radius * std::cos(at), radius * std::sin(at)});
  }
  return region;
}

TEST(Clip, RectanglesMeetInARectangle) {
  const Region a = rectangle(0, 3, 0, 2), b = rectangle(1, 5, -1, 1.5);
  EXPECT_DOUBLE_EQ(measure(intersection(a, b)), 2 * 1.5);
  EXPECT_DOUBLE_EQ(measure(intersection(b, a)), 2 * 1.5);
  EXPECT_EQ(measure(intersection(a, rectangle(4, 5, 0, 1))), 0);
  EXPECT_EQ(measure(intersection(a, rectangle(3, 5, 0, 1))), 0);  // they share an edge
  EXPECT_DOUBLE_EQ(measure(intersection(a, rectangle(-1, 9, -1, 9))), 6);
}

TEST(Clip, TurnedSquaresMeetInAnOctagon) {
  // Two unit squares, one turned by 45°: a regular octagon with the inscribed radius 1/2.
  const double half = std::sqrt(0.5);
  const Region eight = intersection(regular(4, half, 0), regular(4, half, std::numbers::pi / 4));
  EXPECT_EQ(eight.size(), 8u);
  EXPECT_NEAR(measure(eight), 2 * (std::sqrt(2.) - 1), 1e-15);
}

TEST(Clip, TrianglesOverATriangleTileIt) {
  // A fan around a point tiles the plane near it: the parts of any triangle add up to its area.
  std::mt19937 generator(3);
  const Region rim = regular(7, 4, 0.3);
  for (int trial = 0; trial < 200; ++trial) {
    Region triangle{{test::uniform(generator), test::uniform(generator)},
                    {test::uniform(generator), test::uniform(generator)},
                    {test::uniform(generator), test::uniform(generator)}};
    if (measure(triangle) < 0) std::swap(triangle[0], triangle[1]);
    const PlanePoint centre{test::uniform(generator) / 2, test::uniform(generator) / 2};
    double total = 0;
    for (std::size_t i = 0; i < 7; ++i)
      total += measure(intersection(triangle, {centre, rim[i], rim[(i + 1) % 7]}));
    EXPECT_NEAR(total, measure(triangle), 1e-15);
  }
}

TEST(Clip, DifferenceIsWhatTheIntersectionLeaves) {
  const Region a = regular(5, 1, 0.2);
  for (const Region& b : {regular(3, 0.7, 1), regular(6, 0.3, 0), rectangle(0.2, 3, -2, 2),
                          rectangle(2, 3, 2, 3), regular(8, 3, 0)}) {
    double left = 0;
    for (const Region& piece : difference(a, b, 0)) {
      EXPECT_LT(measure(intersection(piece, b)), 1e-15);
      left += measure(piece);
    }
    EXPECT_NEAR(left, measure(a) - measure(intersection(a, b)), 1e-15);
  }
}

TEST(Clip, SegmentsMeetInASegment) {
  const Region a{{0, 0}, {2, 0}}, b{{3, 0}, {0.5, 0}}, c{{0.5, 0}, {1, 0}};
  EXPECT_DOUBLE_EQ(measure(intersection(a, b)), 1.5);
  EXPECT_DOUBLE_EQ(measure(intersection(a, c)), 0.5);
  EXPECT_EQ(measure(intersection(a, {{2.5, 0}, {3, 0}})), 0);
  double left = 0;
  for (const Region& piece : difference(a, c, 0)) left += measure(piece);
  EXPECT_DOUBLE_EQ(left, 1.5);
}

TEST(Clip, HalfPlanesCut) {
  EXPECT_DOUBLE_EQ(measure(clip(rectangle(0, 1, 0, 1), {{-1, -1}, 1})), 0.5);
  EXPECT_DOUBLE_EQ(measure(clip(rectangle(0, 1, 0, 1), {{0, 0}, 1})), 1);
  EXPECT_TRUE(clip(rectangle(0, 1, 0, 1), {{0, 0}, -1}).empty());
}

/// ∫ x^a y^b over a region by the rule of this degree.
double moment(const Region& region, int a, int b, int degree) {
  double sum = 0;
  for (const auto& [y, weight] : quadrature(region, degree))
    sum += weight * std::pow(y[0], a) * std::pow(y[1], b);
  return sum;
}

TEST(Clip, RulesAreExactForTheirDegree) {
  for (const int degree : {1, 4, 6, 8, 10})
    for (int a = 0; a <= degree; ++a) {
      const int b = degree - a;
      const double exact = (std::pow(2., a + 1) - 1) / (a + 1) * std::pow(3., b + 1) / (b + 1);
      EXPECT_NEAR(moment(rectangle(1, 2, 0, 3), a, b, degree), exact, 1e-14 * exact) << a << b;
      const double line = (std::pow(2., degree + 1) - 1) / (degree + 1);
      EXPECT_NEAR(moment({{1, 0}, {2, 0}}, degree, 0, degree), line, 1e-14 * line);
    }
}

TEST(Clip, CentroidIsThatOfTheArea) {
  const PlanePoint centre = centroid({{0, 0}, {4, 0}, {4, 1}, {0, 3}});
  // area 8, moments ∫x = 40/3, ∫y = 26/3 by the height 3 − x/2
  EXPECT_NEAR(centre[0], 40. / 3 / 8, 1e-15);
  EXPECT_NEAR(centre[1], 26. / 3 / 8, 1e-15);
}

// Distorted faces take high degrees: ∫ xⁿ = 1/(n + 1) over the interval, and over the triangle
// ∫ xᵃ yᵇ = a! b! / (a + b + 2)!.
TEST(Quadrature, IsExactForHighDegrees) {
  for (const int degree : {1, 2, 3, 9, 20, 41, 90})
    for (int n = 0; n <= degree; ++n) {
      double line = 0, triangle = 0;
      for (const auto& [x, weight] : quadrature({{0, 0}, {1, 0}}, degree))
        line += weight * std::pow(x[0], n);
      const int a = n / 3, b = n - a;
      for (const auto& [x, weight] : quadrature({{0, 0}, {1, 0}, {0, 1}}, degree))
        triangle += weight * std::pow(x[0], a) * std::pow(x[1], b);
      EXPECT_NEAR(line * (n + 1), 1, 2e-14) << n << " of " << degree;
      const double exact = std::exp(std::lgamma(a + 1) + std::lgamma(b + 1) - std::lgamma(n + 3));
      EXPECT_NEAR(triangle / exact, 1, 1e-12) << n << " of " << degree;
    }
}

}  // namespace
}  // namespace squeal
