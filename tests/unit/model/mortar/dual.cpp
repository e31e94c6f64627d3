// SPDX-License-Identifier: BSD-2-Clause
// Dual functions of slave faces: biorthogonality, the patch test of constant pressure, fields that
// are transferred exactly, matching faces, pivots, and small covered parts.
#include "model/mortar/dual.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "model/mortar/surface.hpp"
#include "support/model/face_patch.hpp"

namespace squeal {
namespace {

using namespace mortar;
using linalg::DenseMatrix;
using test::allPairs, test::FacePatch;
using test::line2, test::line3, test::quad4, test::quad8, test::quad9, test::tri3, test::tri6;

std::vector<double> usual(const FaceType& type, Cover cover, Multiplier multiplier) {
  return std::vector<double>(type.edges.size(), usualAlpha(type, cover, multiplier));
}

std::vector<bool> none(const FaceType& type) { return std::vector<bool>(type.nodes, false); }

/// One slave face with its pivots and its terms.
struct Coupled {
  const FaceType& type;
  std::vector<double> alpha;
  Pivots pivots;
  std::vector<OverlapPoint> points;
  FaceTerms terms;
};

Coupled couple(const Face& slave, const FacePatch& master,
               Multiplier multiplier = Multiplier::nodes, Cover cover = Cover::full,
               std::vector<bool> dropped = {}, const Velocity& velocity = {}) {
  const FaceType& type = faceType(slave.type);
  if (dropped.empty()) dropped = none(type);
  const auto masters = master.pointers();
  Coupled result{type,
                 usual(type, cover, multiplier),
                 pivots(type, multiplier, dropped),
                 overlap(slave, masters, 1),
                 {}};
  result.terms =
      integrate(moments(slave, masters, result.points, velocity), result.alpha, result.pivots);
  return result;
}

/// Returns the largest error of the nodal loads of a uniform pressure on the master, which the
/// slave covers, in parts of the mean area of its faces.
double loadError(const FacePatch& slave, const FacePatch& master) {
  std::vector<double> load(master.points.size()), exact = load;
  for (const Face& face : slave.faces)
    for (const auto& to : couple(face, master).terms.masters)
      for (PetscInt l = 0; l < to.values.columns(); ++l)
        for (PetscInt p = 0; p < to.values.rows(); ++p)
          load[master.faces[to.face].nodes[l]] += to.values(p, l);
  for (const Face& face : master.faces) {
    const auto part = wholeIntegrals(face, std::vector<double>(4, 0.));
    for (std::size_t l = 0; l < part.size(); ++l) exact[face.nodes[l]] += part[l];
  }
  double largest = 0;
  for (std::size_t l = 0; l < load.size(); ++l)
    largest = std::max(largest, std::abs(load[l] - exact[l]));
  const double area = std::accumulate(exact.begin(), exact.end(), 0.);
  return largest * master.faces.size() / area;
}

TEST(Dual, ConstantPressureLoadsTheMasterAsIfItActedThere) {
  for (const auto& [s, m] : allPairs())
    EXPECT_LT(loadError(test::affinePatch(s, 3, 1), test::affinePatch(m, 4, -1)), 2e-14)
        << s << " on " << m;
}

TEST(Dual, ConstantPressureOnDistortedFlatFaces) {
  // The cells end at the edges of both sides; what remains is the rule on roots of polynomials.
  for (const int s : test::surfaceTypes)
    for (const int m : test::surfaceTypes) {
      std::mt19937 generator(5);
      const auto patch = [&](int type, int cells, int sign) {
        return test::facePatch(type, test::unequal(cells, 0.2, generator),
                               test::unequal(cells, 0.2, generator), sign, 0.15 / cells);
      };
      EXPECT_LT(loadError(patch(s, 4, 1), patch(m, 5, -1)), 2e-6) << s << " on " << m;
    }
}

/// A quarter of a flat ring with the radii 1 and 1.5.
Point polar(const Point& x) {
  const double angle = x[0] * std::numbers::pi / 2, radius = 1 + x[1] / 2;
  return {radius * std::cos(angle), -radius * std::sin(angle), 0};
}

TEST(Dual, ConstantPressureOnFlatFacesWithCurvedEdges) {
  // Straight pieces stand for the edges. The error is about 2e-3 of a face that spans 30°, and of
  // the third order in the size of faces.
  for (const int type : {tri6, quad8, quad9}) {
    const auto error = [&](int cells) {
      std::vector<double> x, y;
      for (int i = 0; i <= cells; ++i) x.push_back(double(i) / cells);
      for (int i = 0; i <= cells + 1; ++i) y.push_back(double(i) / (cells + 1));
      return loadError(test::facePatch(type, x, x, 1, 0, polar),
                       test::facePatch(type, y, y, -1, 0, polar));
    };
    const double coarse = error(3), fine = error(6);
    EXPECT_LT(coarse, 2e-3) << type;
    EXPECT_LT(fine, coarse / 6) << type;
  }
}

/// Returns ũ of the nodal values of a face, u = E ũ.
std::vector<double> tilde(const Coupled& c, std::vector<double> u) {
  for (std::size_t e = 0; e < c.alpha.size(); ++e) {
    const auto& [node, ends] = c.type.edges[e];
    u[node] = (u[node] - c.alpha[e] * (u[ends[0]] + u[ends[1]])) / (1 - 2 * c.alpha[e]);
  }
  return u;
}

using Field = std::function<double(const Point&)>;

/// Returns the largest D ũ + B ũ_o − M u_l of a field that both sides interpolate.
double largestJump(const Face& slave, const Coupled& c, const FacePatch& master,
                   const Field& field) {
  std::vector<double> u;
  for (const Point& x : slave.points) u.push_back(field(x));
  u = tilde(c, u);
  double largest = 0;
  for (std::size_t p = 0; p < c.pivots.nodes.size(); ++p) {
    double jump = c.terms.slave[p] * u[c.pivots.nodes[p]];
    for (std::size_t o = 0; o < c.pivots.others.size(); ++o)
      jump += c.terms.others(p, o) * u[c.pivots.others[o]];
    for (const auto& to : c.terms.masters)
      for (PetscInt l = 0; l < to.values.columns(); ++l)
        jump -= to.values(p, l) * field(master.faces[to.face].points[l]);
    largest = std::max(largest, std::abs(jump));
  }
  return largest;
}

double linear(const Point& x) { return 0.3 + 1.7 * x[0] - 0.9 * x[1]; }
double quadratic(const Point& x) { return x[0] * x[0] - 2 * x[0] * x[1] + 0.4 * x[1] * x[1]; }

TEST(Dual, LinearFieldsAreTransferredExactly) {
  for (const auto multiplier : {Multiplier::nodes, Multiplier::corners})
    for (const auto& [s, m] : allPairs()) {
      const auto slave = test::affinePatch(s, 3, 1), master = test::affinePatch(m, 4, -1);
      for (const Face& face : slave.faces) {
        const Coupled c = couple(face, master, multiplier);
        ASSERT_TRUE(c.terms.dual) << s << " on " << m;
        ASSERT_LT(largestJump(face, c, master, linear), 2e-15) << s << " on " << m;
        if (faceType(s).order == 2 && faceType(m).order == 2) {
          ASSERT_LT(largestJump(face, c, master, quadratic), 2e-15) << s << " on " << m;
        }
      }
    }
}

TEST(Dual, EdgesMayHaveDifferentAlpha) {
  const auto master = test::affinePatch(tri3, 4, -1);
  for (const int s : {tri6, quad8, quad9}) {
    const auto slave = test::affinePatch(s, 2, 1);
    for (const Face& face : slave.faces) {
      Coupled c = couple(face, master);
      for (std::size_t e = 0; e < c.alpha.size(); ++e) c.alpha[e] = 0.15 + 0.05 * e;
      c.terms = integrate(moments(face, master.pointers(), c.points), c.alpha, c.pivots);
      ASSERT_TRUE(c.terms.dual) << s;
      EXPECT_LT(largestJump(face, c, master, linear), 2e-15) << s;
    }
  }
}

TEST(Dual, RowsAddUpToTheWeights) {
  for (const auto multiplier : {Multiplier::nodes, Multiplier::corners})
    for (const auto& [s, m] : allPairs()) {
      const auto slave = test::affinePatch(s, 2, 1), master = test::affinePatch(m, 3, -1, 0.1);
      for (const Face& face : slave.faces) {
        const auto terms = couple(face, master, multiplier).terms;
        const double area = std::accumulate(terms.covered.begin(), terms.covered.end(), 0.),
                     weight = std::accumulate(terms.weight.begin(), terms.weight.end(), 0.);
        EXPECT_NEAR(weight, area, 1e-15) << s << " on " << m;
        for (std::size_t p = 0; p < terms.weight.size(); ++p) {
          double slaveSum = terms.slave[p], masterSum = 0;
          for (PetscInt o = 0; o < terms.others.columns(); ++o) slaveSum += terms.others(p, o);
          for (const auto& to : terms.masters)
            for (PetscInt l = 0; l < to.values.columns(); ++l) masterSum += to.values(p, l);
          EXPECT_NEAR(slaveSum, terms.weight[p], 2e-15) << s << " on " << m;
          EXPECT_NEAR(masterSum, terms.weight[p], 2e-15) << s << " on " << m;
          // The gap is 0.1 in magnitude; the normal of lines is −y.
          EXPECT_NEAR(terms.gap[p], (faceType(s).dimension == 1 ? -0.1 : 0.1) * terms.weight[p],
                      1e-15);
        }
      }
    }
}

TEST(Dual, MatchingFacesArePairedNodeByNode) {
  // ∫ ψ_p φ̃_q = d_p δ_pq, with φ̃ = Eᵀφ and M = ∫ ψ φ of the same face: M E = diag(d). Faces may
  // be distorted or curved: the master is the slave itself, seen from the other side.
  const test::Map wavy = [](const Point& x) {
    return Point{x[0], x[1], 0.1 * std::sin(2 * x[0] + x[1])};
  };
  for (const auto& map : {test::Map(test::asItIs), wavy})
    for (const int s : test::surfaceTypes) {
      const auto slave = test::facePatch(s, {0, 0.4, 1}, {0, 0.5, 1}, 1, 0.1, map);
      for (const Face& face : slave.faces) {
        Face other = face;
        other.sign = -1;
        const FacePatch master{{other}, {}};
        const Coupled c = couple(face, master);
        ASSERT_EQ(c.terms.masters.size(), 1u);
        auto product = c.terms.masters[0].values;
        for (std::size_t e = 0; e < c.alpha.size(); ++e) {
          const auto& [node, ends] = c.type.edges[e];
          for (PetscInt p = 0; p < product.rows(); ++p) {
            const double value = product(p, node);
            product(p, node) = (1 - 2 * c.alpha[e]) * value;
            for (const int end : ends) product(p, end) += c.alpha[e] * value;
          }
        }
        for (PetscInt p = 0; p < product.rows(); ++p)
          for (PetscInt q = 0; q < product.columns(); ++q)
            ASSERT_NEAR(product(p, q), p == q ? c.terms.slave[p] : 0, 2e-15) << s;
      }
    }
}

TEST(Dual, CornersCarryTheWholeWeight) {
  // On affine faces W is the area by the number of corners, and D = W/6 on tri6 (α = 1/12), W/5 on
  // quad8 (α = 1/5), W · 4/36 on quad9 (α = 0).
  for (const auto& [type, ratio] : {std::pair{tri6, 1. / 6}, {quad8, 1. / 5}, {quad9, 1. / 9}}) {
    const auto slave = test::facePatch(type, {0, 1}, {0, 1}, 1),
               master = test::affinePatch(quad4, 3, -1);
    const Coupled c = couple(slave.faces[0], master, Multiplier::corners);
    const double part = type == tri6 ? 0.5 / 3 : 1. / 4;
    for (std::size_t p = 0; p < c.pivots.nodes.size(); ++p) {
      EXPECT_NEAR(c.terms.weight[p], part, 3e-15) << type;
      EXPECT_NEAR(c.terms.slave[p], ratio * part, 3e-15) << type;
    }
  }
}

TEST(Dual, PivotsAddUpToOneWithoutTheDroppedNodes) {
  for (const int number : {line2, line3, tri3, tri6, quad4, quad8, quad9}) {
    const FaceType& type = faceType(number);
    for (const auto multiplier : {Multiplier::nodes, Multiplier::corners}) {
      std::vector<bool> dropped = none(type);
      dropped[1] = dropped[type.nodes - 1] = true;
      const Pivots some = pivots(type, multiplier, dropped);
      EXPECT_EQ(std::ssize(some.nodes) + std::ssize(some.others), type.nodes);
      for (const int node : some.nodes) EXPECT_FALSE(dropped[node]);
      for (PetscInt i = 0; i < type.nodes; ++i) {
        const auto column = some.functions.column(i);
        EXPECT_NEAR(std::accumulate(column.begin(), column.end(), 0.), 1, 1e-15) << number;
      }
      const Pivots no = pivots(type, multiplier, std::vector<bool>(type.nodes, true));
      EXPECT_TRUE(no.nodes.empty());
    }
  }
}

TEST(Dual, LinearFieldsSurviveDroppedNodes) {
  for (const auto multiplier : {Multiplier::nodes, Multiplier::corners})
    for (const int s : {line3, tri3, tri6, quad4, quad8, quad9}) {
      const bool line = faceType(s).dimension == 1;
      const auto slave = test::affinePatch(s, 2, 1),
                 master = test::affinePatch(line ? line2 : quad4, 3, -1);
      std::vector<bool> dropped = none(faceType(s));
      dropped[0] = dropped.back() = true;
      for (const Face& face : slave.faces) {
        const Coupled c = couple(face, master, multiplier, Cover::full, dropped);
        ASSERT_TRUE(c.terms.dual) << s;
        EXPECT_LT(largestJump(face, c, master, linear), 1e-14) << s;
        const double area = std::accumulate(c.terms.covered.begin(), c.terms.covered.end(), 0.);
        EXPECT_NEAR(std::accumulate(c.terms.weight.begin(), c.terms.weight.end(), 0.), area, 1e-15);
      }
    }
}

TEST(Dual, ConvectedTermsAreTheDerivativeAlongTheVelocity) {
  const Point velocity{2, -3, 5};  // its normal part does not count
  for (const auto& [s, m] : allPairs()) {
    const bool line = faceType(s).dimension == 1;
    const double exact = line ? 1.7 * 2 : 1.7 * 2 + 0.9 * 3;
    const auto slave = test::affinePatch(s, 2, 1), master = test::affinePatch(m, 3, -1);
    for (const Face& face : slave.faces) {
      const auto terms =
          couple(face, master, Multiplier::nodes, Cover::full, {}, [&](std::size_t, const Point&) {
            return velocity;
          }).terms;
      for (std::size_t p = 0; p < terms.weight.size(); ++p) {
        double sum = 0;
        for (const auto& to : terms.masters)
          for (PetscInt l = 0; l < to.convected.columns(); ++l)
            sum += to.convected(p, l) * linear(master.faces[to.face].points[l]);
        EXPECT_NEAR(sum, exact * terms.weight[p], 1e-13) << s << " on " << m;
      }
    }
  }
}

TEST(Dual, SmallCoveredPartsKeepTheTotalForce) {
  // A square master of decreasing size inside of one slave face: the functions look alike on it.
  for (const int s : test::surfaceTypes)
    for (const double size : {0.3, 1e-1, 1e-2, 1e-4, 1e-6}) {
      const auto slave = test::facePatch(s, {0, 1}, {0, 1}, 1),
                 master = test::facePatch(quad4, {0.2, 0.2 + size}, {0.7, 0.7 + size}, -1);
      double force = 0, load = 0;
      for (const Face& face : slave.faces) {
        const Coupled c = couple(face, master, Multiplier::nodes, Cover::partial);
        force += std::accumulate(c.terms.slave.begin(), c.terms.slave.end(), 0.);
        for (const auto& to : c.terms.masters)
          for (const double entry : to.values.entries()) load += entry;
        for (const double d : c.terms.slave) EXPECT_TRUE(d >= 0 || s == quad9) << s;
        EXPECT_LT(largestJump(face, c, master, [](const Point&) { return 1; }),
                  1e-13 * size * size);
      }
      EXPECT_NEAR(force / (size * size), 1, 1e-9) << s << " " << size;
      EXPECT_NEAR(load, force, 1e-13 * size * size) << s << " " << size;
    }
}

TEST(Dual, NothingCoveredGivesNothing) {
  const auto slave = test::facePatch(tri6, {0, 1}, {0, 1}, 1);
  const auto terms = couple(slave.faces[0], {}).terms;
  EXPECT_TRUE(terms.masters.empty());
  EXPECT_EQ(terms.weight, std::vector<double>(6, 0.));
  EXPECT_EQ(terms.covered, std::vector<double>(6, 0.));
}

}  // namespace
}  // namespace squeal
