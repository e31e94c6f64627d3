// SPDX-License-Identifier: BSD-2-Clause
// Integration points over the part of slave faces that master faces cover: areas, polynomials,
// gaps, and what counts as covered.
#include "model/mortar/overlap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "base/petsc/check.hpp"
#include "model/mesh/vector.hpp"
#include "model/mortar/clip.hpp"
#include "model/mortar/dual.hpp"
#include "model/mortar/surface.hpp"
#include "support/model/face_patch.hpp"

namespace squeal {
namespace {

using namespace mortar;
using mesh::dot, mesh::length, mesh::minus, mesh::plus;
using test::allPairs, test::FacePatch;
using test::line2, test::line3, test::quad4, test::quad8, test::quad9, test::tri3, test::tri6;

/// Returns the sum of f(x) · weight over the points of a patch, x on the slave.
double integral(const FacePatch& slave, const FacePatch& master, double distance,
                const std::function<double(const Point&, const OverlapPoint&)>& f) {
  double sum = 0;
  for (const Face& face : slave.faces)
    for (const auto& point : overlap(face, master.pointers(), distance))
      sum += point.weight * f(facePoint(face, point.slave).position, point);
  return sum;
}

double area(const FacePatch& slave, const FacePatch& master, double distance = 1) {
  return integral(slave, master, distance, [](const Point&, const OverlapPoint&) { return 1; });
}

FacePatch distorted(int type, int cells, int sign, const test::Map& map = test::asItIs) {
  std::mt19937 generator(cells);
  return test::facePatch(type, test::unequal(cells, 0.2, generator),
                         test::unequal(cells, 0.2, generator), sign, 0.2 / cells, map);
}

TEST(Overlap, DistortedFlatPatchesCoverEachOther) {
  for (const auto& [s, m] : allPairs()) {
    SCOPED_TRACE(testing::Message() << s << " on " << m);
    const auto slave = distorted(s, 3, 1), master = distorted(m, 4, -1);
    EXPECT_NEAR(area(slave, master), 1, 1e-13);
    for (const Face& face : slave.faces) {
      double covered = 0, whole = 0;
      for (const auto& point : overlap(face, master.pointers(), 1)) covered += point.weight;
      const auto& type = faceType(face.type);
      Region polygon;
      for (int c = 0; c < type.corners; ++c)
        polygon.push_back({face.points[c][0], face.points[c][1]});
      whole = measure(polygon);
      EXPECT_NEAR(covered, whole, 1e-14);
    }
  }
}

TEST(Overlap, PartsAreCutAtTheMastersEdges) {
  // The master is turned by 30° and moved; the areas of all pairs of corner polygons are exact.
  const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
  const test::Map turned = [&](const Point& x) {
    return Point{0.4 + c * x[0] - s * x[1], 0.1 + s * x[0] + c * x[1], 0};
  };
  // the common area of the unit square and the turned one
  const Region other{
      {0.4, 0.1}, {0.4 + c, 0.1 + s}, {0.4 + c - s, 0.1 + s + c}, {0.4 - s, 0.1 + c}};
  const double exact = measure(intersection({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, other));
  EXPECT_GT(exact, 0.3);
  for (const int slave : test::surfaceTypes)
    for (const int master : test::surfaceTypes)
      EXPECT_NEAR(area(distorted(slave, 3, 1), distorted(master, 4, -1, turned)), exact, 1e-13)
          << slave << " on " << master;
  for (const int slave : test::lineTypes)
    for (const int master : test::lineTypes)
      EXPECT_NEAR(area(distorted(slave, 3, 1), distorted(master, 4, -1,
                                                         [](const Point& x) {
                                                           return Point{0.3 + 2 * x[0], -0.01, 0};
                                                         })),
                  0.7, 1e-14);
}

TEST(Overlap, PolynomialsAreIntegratedExactlyOnAffineFaces) {
  for (const auto& [s, m] : allPairs()) {
    const bool line = faceType(s).dimension == 1;
    const double value = integral(test::affinePatch(s, 3, 1), test::affinePatch(m, 4, -1, 0.1), 1,
                                  [](const Point& x, const OverlapPoint&) {
                                    return std::pow(x[0], 3) + x[0] * x[1] * x[1] + x[1];
                                  });
    EXPECT_NEAR(value, line ? 0.25 : 0.25 + 1. / 6 + 0.5, 1e-14) << s << " on " << m;
  }
}

TEST(Overlap, PointsOfBothSidesLieOnTheNormal) {
  // Both sides are wavy, and the faces curved.
  const test::Map below = [](const Point& x) {
    return Point{x[0], x[1], 0.03 * std::sin(3 * x[0] + 2 * x[1])};
  };
  const test::Map above = [](const Point& x) {
    return Point{x[0] * 1.2 - 0.1, x[1] * 1.2 - 0.1, 0.05 + 0.02 * std::cos(4 * x[0] - x[1])};
  };
  for (const int s : test::surfaceTypes)
    for (const int m : test::surfaceTypes) {
      const auto slave = distorted(s, 3, 1, below), master = distorted(m, 5, -1, above);
      for (const Face& face : slave.faces)
        for (const auto& point : overlap(face, master.pointers(), 1)) {
          const auto here = facePoint(face, point.slave),
                     there = facePoint(master.faces[point.masterFace], point.master);
          const Point defect = minus(there.position, plus(here.position, point.normal, point.gap));
          ASSERT_LT(length(defect), 1e-14) << s << " on " << m;
          ASSERT_NEAR(dot(point.normal, here.normal), length(here.normal), 1e-14);
          ASSERT_GT(point.gap, 0);
        }
    }
}

TEST(Overlap, FacesThatLookAwayOrLieFarDoNotCover) {
  for (const int type : {tri6, quad4, line3}) {
    const double side = faceType(type).dimension == 1 ? -1 : 1;  // of the slave's normal
    const auto slave = test::affinePatch(type, 2, 1);
    const auto at = [&](double height, int sign) {
      return area(slave, test::affinePatch(type, 3, sign, side * height), 0.1);
    };
    EXPECT_NEAR(at(0.05, -1), 1, 1e-14);
    EXPECT_NEAR(at(-0.05, -1), 1, 1e-14);
    EXPECT_EQ(at(0.05, 1), 0);
    EXPECT_EQ(at(0.2, -1), 0);
    EXPECT_EQ(at(-0.2, -1), 0);
  }
}

TEST(Overlap, TheDistanceCutsWhereTheGapReachesIt) {
  // The master rises by 0.2 x: it is nearer than 0.1 for x < 1/2.
  for (const int type : test::surfaceTypes) {
    const auto master = distorted(type, 4, -1, [](const Point& x) {
      return Point{x[0], x[1], 0.2 * x[0]};
    });
    EXPECT_NEAR(area(distorted(quad4, 3, 1), master, 0.1), 0.5, 1e-13) << type;
  }
}

TEST(Overlap, TheNearerOfTwoMastersCounts) {
  // Two layers that cross at x = 1/2, each nearer on one side, and a third one further away.
  for (const int type : {tri3, tri6, quad9}) {
    FacePatch master = test::affinePatch(type, 3, -1, 0.02);
    for (const auto& more :
         {test::affinePatch(type, 4, -1, -0.01), test::affinePatch(type, 2, -1, 0.05)})
      master.faces.insert(master.faces.end(), more.faces.begin(), more.faces.end());
    const auto slave = test::affinePatch(quad8, 3, 1);
    EXPECT_NEAR(area(slave, master), 1, 1e-12);
    EXPECT_NEAR(
        integral(slave, master, 1, [](const Point&, const OverlapPoint& p) { return p.gap; }),
        -0.01, 1e-13);
  }
  // A near patch with a border: the far one counts beside it.
  FacePatch master = test::affinePatch(quad4, 3, -1, 0.02);
  const auto part = test::facePatch(tri3, {0.2, 0.7}, {0.1, 0.9}, -1, 0, [](const Point& x) {
    return Point{x[0], x[1], 0.01};
  });
  master.faces.insert(master.faces.end(), part.faces.begin(), part.faces.end());
  const auto slave = test::affinePatch(tri6, 3, 1);
  EXPECT_NEAR(area(slave, master), 1, 1e-12);
  EXPECT_NEAR(integral(slave, master, 1, [](const Point&, const OverlapPoint& p) { return p.gap; }),
              0.02 - 0.01 * 0.5 * 0.8, 1e-13);
}

/// A quarter of a cylinder of radius 1 and height 1, or of a circle.
Point bent(const Point& x) {
  const double angle = x[0] * std::numbers::pi / 2;
  return {std::cos(angle), std::sin(angle), x[1]};
}

/// A quarter of a flat ring with the radii 1 and 1.5.
Point polar(const Point& x) {
  const double angle = x[0] * std::numbers::pi / 2, radius = 1 + x[1] / 2;
  return {radius * std::cos(angle), -radius * std::sin(angle), 0};
}

/// Unequal cells, triangles of any shape.
FacePatch mapped(int type, int cells, int sign, const test::Map& map) {
  std::mt19937 generator(cells);
  const auto x = test::unequal(cells, 0.2, generator), y = test::unequal(cells, 0.2, generator);
  const double jitter = faceType(type).corners == 3 ? 0.1 / cells : 0;
  return test::facePatch(type, x, y, sign, jitter, map);
}

struct Covered {
  double missing = 0;  ///< of the area of the slave
  double area = 0;     ///< of the slave by the rule of whole faces
  double gap = 0;      ///< the largest magnitude
};

Covered coverOf(int s, int m, int cells, const test::Map& map) {
  const auto slave = mapped(s, cells, 1, map), master = mapped(m, cells + 1, -1, map);
  Covered result;
  const double covered = integral(slave, master, 0.3, [&](const Point&, const OverlapPoint& point) {
    result.gap = std::max(result.gap, std::abs(point.gap));
    return 1;
  });
  for (const Face& face : slave.faces) {  // a face covers itself
    Face other = face;
    other.sign = -face.sign;
    result.missing += area({{face}, {}}, {{other}, {}});
    const auto parts = wholeIntegrals(face, std::vector<double>(4, 0.));
    result.area += std::accumulate(parts.begin(), parts.end(), 0.);
  }
  result.missing -= covered;
  EXPECT_NEAR(covered, result.area, 1e-5 * covered);  // an integral of a root by two rules
  return result;
}

TEST(Overlap, CylindersOfDifferentMeshesCoverEachOther) {
  for (const auto& [s, m] : allPairs()) {
    SCOPED_TRACE(testing::Message() << s << " on " << m);
    const Covered coarse = coverOf(s, m, 3, bent), fine = coverOf(s, m, 6, bent);
    // The area of a curved face is an integral of a root, here by rules on different cells.
    EXPECT_NEAR(coarse.missing, 0, 1e-8);
    EXPECT_NEAR(fine.missing, 0, 1e-10);
    // Facets leave the cylinder by h²/8, quadratic faces by about h³; h is halved, but the meshes
    // are unequal.
    const bool linear = std::min(faceType(s).order, faceType(m).order) == 1;
    EXPECT_LT(fine.gap, coarse.gap / (linear ? 2.5 : 8));
  }
}

TEST(Overlap, CurvedRimsOfFlatFacesCoverEachOther) {
  // Triangles between nodes do not reach the rim where it is convex, and those of different meshes
  // end at different chords: without what reaches beyond edges, about 1e-3 would be missing.
  for (const int s : {tri6, quad8, quad9})
    for (const int m : {tri6, quad8, quad9}) {
      SCOPED_TRACE(testing::Message() << s << " on " << m);
      for (const int cells : {3, 5}) {
        const Covered cover = coverOf(s, m, cells, polar);
        EXPECT_NEAR(cover.missing, 0, 1e-13);
        EXPECT_EQ(cover.gap, 0);
      }
    }
}

TEST(Overlap, AnOverhangIsNotCovered) {
  // Straight edges end where they end, whatever the gap between parallel faces.
  for (const auto& [s, m] : allPairs()) {
    const bool line = faceType(s).dimension == 1;
    const test::Map half = [&](const Point& x) { return Point{0.5 * x[0], x[1], 0.1 * !line}; };
    EXPECT_NEAR(area(distorted(s, 3, 1), distorted(m, 4, -1, half)), 0.5, 1e-13)
        << s << " on " << m;
  }
}

TEST(Overlap, LinesThatMissAFaceEndAtItsRim) {
  const Face face = test::facePatch(quad9, {0, 1}, {0, 1}, 1, 0, [](const Point& x) {
                      return Point{x[0], x[1], 0.1 * x[0] * x[1]};
                    }).faces[0];
  const auto inside = project(face, {0.5, 0.25, 2}, {0, 0, 1});
  EXPECT_TRUE(inside.met);
  EXPECT_NEAR(inside.reference[0], 0, 1e-14);
  EXPECT_NEAR(inside.reference[1], -0.5, 1e-14);
  EXPECT_NEAR(inside.distance, 0.1 * 0.125 - 2, 1e-14);
  const auto beside = project(face, {1.1, 0.5, 0}, {0, 0, 1});
  EXPECT_TRUE(beside.met);
  EXPECT_NEAR(beside.reference[0], 1.2, 1e-14);
  const auto outside = project(face, {4, 0.5, 0}, {0, 0, 1});
  EXPECT_FALSE(outside.met);
  EXPECT_EQ(outside.reference[0], 1);
  const auto parallel = project(face, {4, 0.5, 7}, {0, 1, 0});
  EXPECT_FALSE(parallel.met);
  EXPECT_TRUE(std::isfinite(parallel.distance));
}

TEST(Overlap, FoldedSlaveFacesAreRefused) {
  const auto arch = [](double height) {
    return FacePatch{{Face{line3, {}, {}, {{0, 0, 0}, {1, 0, 0}, {0.5, -height, 0}}, 1, 0}}, {}};
  };
  const auto master = test::facePatch(line2, {0, 1}, {}, -1);
  // A parabola of height 1/2 over the length 1: ∫ √(1 + 4 u²) du from 0 to 1 by five points.
  EXPECT_NEAR(area(arch(0.5), master), std::sqrt(5.) / 2 + std::asinh(2.) / 4, 1e-3);
  EXPECT_THROW(area(arch(5), master, 10), Error);
}

}  // namespace
}  // namespace squeal
