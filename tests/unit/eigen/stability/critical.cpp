// SPDX-License-Identifier: BSD-2-Clause
// Critical frictions of small dense families against closed forms and brute force.
#include "eigen/stability/critical.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "algebra/linalg/spread.hpp"
#include "eigen/pencil/band.hpp"
#include "eigen/reduction/reduced.hpp"
#include "eigen/tracking/track.hpp"
#include "support/eigen/friction_families.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using test::crossingModes;
using test::expectNoGaps;
using test::grid;
using test::Linear;
using test::modal;
using test::print;
using test::randomFamily;

// Two modes of 600 and 660 rad/s that merge at f = (ω2² − ω1²) / (2 ω0²), and a third that is in
// their way: at f = 0 between them, it takes no part.
TEST(Critical, CoalescenceOfTwo) {
  const double w1 = 600, w2 = 660, w0 = 500, exact = (w2 * w2 - w1 * w1) / (2 * w0 * w0);
  Linear family = modal({w1 * w1, 630 * 630, w2 * w2}, {{0, 2, w0 * w0}});
  for (const int steps : {1, 2, 7}) {
    const auto branches = track(family, grid(0.5, steps), {});
    const auto found = stability::criticalFrictions(family, branches, 1e-9);
    expectNoGaps(branches);
    EXPECT_EQ(branches.count, 3);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].kind, tracking::Event::Kind::coalescence);
    EXPECT_TRUE(found[0].loss && found[0].converged);
    // 2 ω s' = … : (s1 − s2)²/4 is ((ω1² + ω2²)/2 − √(ω1² ω2² + f² ω0⁴))/2 beyond: its slope at the
    // critical friction is f ω0⁴ / (2 √(…)), the root being (ω1² + ω2²)/2.
    const double slope = exact * std::pow(w0, 4) / (w1 * w1 + w2 * w2);
    EXPECT_NEAR(found[0].slope, slope, 1e-5 * slope);
    EXPECT_NEAR(found[0].angularFrequency, std::sqrt((w1 * w1 + w2 * w2) / 2), 1e-7 * w1);
    print("%d steps, %zu stations: critical friction wrong by %.1e\n", steps,
          branches.stations.size(), found[0].friction / exact - 1);
    EXPECT_NEAR(found[0].friction, exact, 1e-10 * exact);
  }
}

/// Two modes that friction couples and damps, both in proportion to g = f, or to g = top − f.
struct DampedByFriction : tracking::Family {
  double eta1, eta2, top;
  bool falls, isEmpty;  // isEmpty: no damping matrix where g = 0
  DampedByFriction(double one, double two, double end, bool isFalling, bool withoutMatrix)
      : eta1(one), eta2(two), top(end), falls(isFalling), isEmpty(withoutMatrix) {}
  static constexpr double w1 = 600, w2 = 660, w0 = 500;
  MPI_Comm comm() const override { return PETSC_COMM_WORLD; }
  bool isAffine() const override { return true; }
  std::optional<linalg::DenseProblem> at(double f) override {
    const double g = falls ? top - f : f;
    Linear undamped = modal({w1 * w1, w2 * w2}, {{0, 1, w0 * w0}});
    auto problem = undamped.at(g);
    if (g != 0 || !isEmpty) problem->damping = test::diagonal(std::vector{eta1 * g, eta2 * g});
    return problem;
  }
  /// The g at which one of the growth rates is zero, from the condition of Routh and Hurwitz below.
  double root() const {
    const double a = (eta1 * w2 * w2 + eta2 * w1 * w1) / (eta1 + eta2);
    return std::sqrt((a - w1 * w1) * (w2 * w2 - a) / (std::pow(w0, 4) - a * eta1 * eta2));
  }
};

// At friction 0 all eigenvalues are neutral without damping. Friction damps both modes at first;
// then one of them grows, though the signs at both ends suggest that it grows from 0 on. With the
// opposite sign both grow at first, and one of them decays again. The same ends the sweep.
TEST(Critical, NeutralAtAnEnd) {
  constexpr double top = 0.1;
  using Expected = std::vector<std::pair<double, bool>>;  // friction, whether stability is lost
  for (const int sign : {1, -1})
    for (const bool falls : {false, true})
      for (const bool isEmpty : {false, true})
        for (const int steps : {1, 2, 7}) {
          SCOPED_TRACE(testing::Message() << sign << falls << isEmpty << steps);
          DampedByFriction family(sign * 1.0, sign * 30.0, top, falls, isEmpty);
          const double root = falls ? top - family.root() : family.root();
          Expected expected{{root, (sign > 0) != falls}};
          if (sign < 0)  // both grow near the neutral end
            expected.insert(falls ? expected.end() : expected.begin(), 2,
                            {falls ? top : 0, !falls});
          const auto branches = track(family, grid(top, steps), {});
          expectNoGaps(branches);
          const auto found = stability::criticalFrictions(family, branches, 1e-9);
          ASSERT_EQ(found.size(), expected.size());
          for (std::size_t k = 0; k < found.size(); ++k) {
            EXPECT_EQ(found[k].kind, tracking::Event::Kind::crossing);
            EXPECT_TRUE(found[k].converged);
            EXPECT_EQ(found[k].loss, expected[k].second);
            if (expected[k].first != root) {  // at the neutral end: a mode without friction
              EXPECT_LT(std::min(std::abs(found[k].angularFrequency - family.w1),
                                 std::abs(found[k].angularFrequency - family.w2)),
                        1e-9 * family.w1);
            }
            EXPECT_NEAR(found[k].friction, expected[k].first, 1e-9 * top);
          }
        }
}

/// A mode with the growth rate rate · growth(f) in units of its angular frequency, and one that
/// decays.
struct SlowGrowth : tracking::Family {
  static constexpr double w = 600;
  double rate;
  std::function<double(double)> growth;
  SlowGrowth(double size, std::function<double(double)> function)
      : rate(size), growth(std::move(function)) {}
  MPI_Comm comm() const override { return PETSC_COMM_WORLD; }
  bool isAffine() const override { return true; }
  std::optional<linalg::DenseProblem> at(double f) override {
    auto problem = modal({w * w, 700 * 700}, {}).at(f);
    problem->damping = test::diagonal(std::vector{-2 * w * rate * growth(f), 50.0});
    return problem;
  }
};

// Eigenvalues within 1e-10 |s| of the axis count as neutral: here at several stations, on both
// sides of the root. The change is at the root, not at the last of these stations. Without a root,
// no change.
TEST(Critical, NeutralAtSeveralStations) {
  constexpr double root = 0.37, rate = 4e-10;
  for (const double sign : {1.0, -1.0})
    for (const int steps : {2, 9, 20}) {
      SlowGrowth family(sign * rate, [&](double f) { return f - root; });
      const auto branches = track(family, grid(1, steps), {});
      expectNoGaps(branches);
      const auto found = stability::criticalFrictions(family, branches, 1e-6);
      ASSERT_EQ(found.size(), 1u);
      EXPECT_EQ(found[0].kind, tracking::Event::Kind::crossing);
      EXPECT_EQ(found[0].loss, sign > 0);
      EXPECT_TRUE(found[0].converged);
      // The round-off of s, a few 1e-16 |s|, over its slope of 4e-10 |s|.
      EXPECT_NEAR(found[0].friction, root, 1e-5);
    }
  SlowGrowth grows(10 * rate, [&](double f) { return std::pow(f - root, 2) + 0.01; });
  EXPECT_TRUE(track(grows, grid(1, 20), {}).events.empty());
}

// The same with damping: Routh and Hurwitz (tests/verification/minimal_models.cpp).
TEST(Critical, HopfOfDampedModes) {
  const double w1 = 600, w2 = 660, w0 = 500;
  for (const auto& [eta1, eta2] : {std::pair{1.0, 30.0}, {30.0, 6.0}, {30.0, 30.0}, {1e-3, 2e-3}}) {
    const double a3 = eta1 + eta2, a2 = w1 * w1 + w2 * w2 + eta1 * eta2,
                 a1 = eta1 * w2 * w2 + eta2 * w1 * w1;
    const double exact =
        std::sqrt(a1 * a2 / a3 - std::pow(a1 / a3, 2) - std::pow(w1 * w2, 2)) / (w0 * w0);
    Linear family = modal({w1 * w1, 630 * 630, w2 * w2}, {{0, 2, w0 * w0}}, {eta1, 10, eta2});
    const auto branches = track(family, grid(0.5, 3), {});
    const auto found = stability::criticalFrictions(family, branches, 1e-9);
    expectNoGaps(branches);
    EXPECT_EQ(branches.count, 3);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].kind, tracking::Event::Kind::crossing);
    EXPECT_TRUE(found[0].loss);
    EXPECT_GT(found[0].slope, 0);
    EXPECT_NEAR(found[0].angularFrequency, std::sqrt(a1 / a3), 1e-8 * w1);
    print("damping %g, %g: critical friction wrong by %.1e, %zu stations\n", eta1, eta2,
          found[0].friction / exact - 1, branches.stations.size());
    EXPECT_NEAR(found[0].friction, exact, 1e-10 * exact);
  }
}

/// Round-off adds `roundOff` to the entries of the problem. The backward error of an eigenvalue is
/// a thousandth of its friction.
struct Rounded : Linear {
  double roundOff;
  Rounded(Linear linear, double amount) : Linear(std::move(linear)), roundOff(amount) {}
  reduction::Improvement improve(const std::vector<tracking::PairsAtFriction>& located) override {
    return {true, std::vector<double>(located.size(), 0.0),
            std::vector<double>(located.size(), roundOff)};
  }
  reduction::Improvement errorsOf(const std::vector<tracking::PairsAtFriction>& located) override {
    reduction::Improvement errors{false, {}, std::vector<double>(located.size(), roundOff)};
    for (const auto& item : located) errors.backwardError.push_back(1e-3 * item.friction);
    return errors;
  }
};

// Two modes cross at f = 0.1 with s² = −11000, where the entries b and −c couple them: they are
// unstable while |10⁴ (f − 0.1)| < √(bc), which round-off r of the entries moves by b r/(2 √(bc)).
// A growth that this may undo is not listed.
TEST(Critical, GrowthWithinTheRoundOffOfACrossing) {
  const double b = 1e3, c = 1e-5, root = std::sqrt(b * c);
  Linear modes = crossingModes({1e4, 1.2e4}, {1e4, -1e4}, {});
  modes.base.stiffness(0, 1) = b;
  modes.base.stiffness(1, 0) = -c;
  for (const double roundOff : {1e-8, 1e-6, 1e-4}) {
    Rounded family(modes, roundOff);
    const auto branches = track(family, grid(0.2, 2), {});
    const auto found = stability::criticalFrictions(family, branches, 1e-9);
    const double error = b * roundOff / (2 * root) / 1e4;
    if (error > root / 1e4) {
      EXPECT_TRUE(found.empty());
      continue;
    }
    ASSERT_EQ(found.size(), 2u);
    for (const auto& one : found) {
      EXPECT_NEAR(one.friction, 0.1 + (one.loss ? -1 : 1) * root / 1e4, 1e-11);
      EXPECT_EQ(one.backwardError, 1e-3 * one.friction);  // of the eigenvalue found last
      // The vectors are all but parallel to the axis of b.
      EXPECT_NEAR(one.errorEstimate, error, 0.1 * error);
    }
  }
}

/// Coupling f (1 + f²) where f stands elsewhere, and near() by straight lines between the frictions
/// known.
struct Interpolated : Linear {
  std::vector<double> frictions;
  int solved = 0;
  explicit Interpolated(Linear linear) : Linear(std::move(linear)) {}
  std::optional<linalg::DenseProblem> at(double f) override {
    ++solved;
    return Linear::at(f * (1 + f * f));
  }
  std::optional<linalg::DenseProblem> near(double f) override {
    const auto above = std::upper_bound(frictions.begin() + 1, frictions.end() - 1, f),
               below = above - 1;
    const double t = (f - *below) / (*above - *below);
    return Linear::at((1 - t) * (*below) * (1 + *below * *below) +
                      t * (*above) * (1 + *above * *above));
  }
  void addFrictions(const std::vector<double>& list) override {
    frictions.insert(frictions.end(), list.begin(), list.end());
    std::sort(frictions.begin(), frictions.end());
    frictions.erase(std::unique(frictions.begin(), frictions.end()), frictions.end());
  }
  reduction::Improvement improve(const std::vector<tracking::PairsAtFriction>& located) override {
    for (const auto& item : located) addFrictions({item.friction});
    return {true, std::vector<double>(located.size(), 0.0),
            std::vector<double>(located.size(), 0.0)};
  }
};

// What near() gets wrong is set right where a root is found: the coalescence of CoalescenceOfTwo at
// f (1 + f²) = 0.1512. No problem is solved for beyond those of the stations.
TEST(Critical, RootOfAnInterpolatedFamily) {
  const double w1 = 600, w2 = 660, w0 = 500, coupling = (w2 * w2 - w1 * w1) / (2 * w0 * w0);
  double exact = coupling;
  for (int k = 0; k < 60; ++k) exact = coupling / (1 + exact * exact);
  Interpolated family(modal({w1 * w1, 630 * 630, w2 * w2}, {{0, 2, w0 * w0}}));
  const auto branches = track(family, grid(0.5, 1), {});
  const int before = family.solved;
  const double tolerance = 1e-6;
  const auto found = stability::criticalFrictions(family, branches, tolerance);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].converged);
  EXPECT_EQ(family.solved, before);
  print("critical friction wrong by %.1e\n", found[0].friction / exact - 1);
  EXPECT_NEAR(found[0].friction, exact, tolerance * exact);
}

// Modes that come close, merge over a short stretch of friction and part again within one step: 2 g
// f c, c = 0.02, is the coupling; they cross at f = 0.5. (d)² = (c f)² at 10 (f − 0.5) = ± c f.
TEST(Critical, MergerWithinOneStep) {
  const double c = 0.02;
  Linear family = crossingModes({100, 110}, {20, 0}, {{0, 1, c}});
  const auto branches = track(family, {0, 1}, {});
  const auto found = stability::criticalFrictions(family, branches, 1e-9);
  expectNoGaps(branches);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_TRUE(found[0].loss);
  EXPECT_FALSE(found[1].loss);
  EXPECT_NEAR(found[0].friction, 5 / (10 + c), 1e-10);
  EXPECT_NEAR(found[1].friction, 5 / (10 - c), 1e-10);
}

// Symmetric coupling makes them veer instead.
TEST(Critical, VeeringIsNoMerger) {
  Linear family = crossingModes({100, 110}, {20, 0}, {});
  family.base.stiffness(1, 0) = family.base.stiffness(0, 1) = 0.05;
  for (const int steps : {1, 3, 8}) {
    const auto branches = track(family, grid(1, steps), {});
    expectNoGaps(branches);
    EXPECT_TRUE(branches.events.empty());
  }
}

/// Unstable eigenvalues at one friction.
int unstableAt(tracking::Family& family, double f) {
  const auto problem = *family.at(f);
  int count = 0;
  for (const auto& pair : linalg::solveTogether(PETSC_COMM_WORLD, problem))
    count += pair.s.real() > 1e-6 * std::abs(pair.s);
  return count;
}

int changesBetween(const std::vector<stability::Critical>& list, double low, double high) {
  int change = 0;
  for (const auto& critical : list)
    if (critical.friction > low && critical.friction < high) change += critical.loss ? 1 : -1;
  return change;
}

/// The number of unstable eigenvalues on a fine grid is what the critical frictions say.
void expectCounts(tracking::Family& family, const std::vector<stability::Critical>& found,
                  double top) {
  const int samples = 150;
  for (int k = 1; k <= samples; ++k) {
    const double f = top * k / samples;
    bool close = false;
    for (const auto& critical : found) close = close || std::abs(critical.friction - f) < 1e-6;
    if (close) continue;
    EXPECT_EQ(unstableAt(family, f), changesBetween(found, -1, f)) << "f = " << f;
  }
}

TEST(Critical, RandomFamiliesAgainstAFineGrid) {
  for (const bool damped : {false, true})
    for (const unsigned seed : {1u, 2u, 3u}) {
      const int m = seed % 2 == 1 ? 30 : 20;
      Linear family = randomFamily(m, seed, damped);
      const double top = damped ? 0.8 : 1;  // beyond, a damped pair becomes two real eigenvalues:
                                            // no continuation of one by one
      const auto branches = track(family, grid(top, 10), {});
      const auto found = stability::criticalFrictions(family, branches, 1e-9);
      print("%s family of %d: %zu stations, %d branches, %zu critical frictions, %zu gaps\n",
            damped ? "damped" : "undamped", m, branches.stations.size(), branches.count,
            found.size(), branches.gaps.size());
      expectNoGaps(branches);
      EXPECT_EQ(branches.count, m);
      EXPECT_GT(found.size(), 2u);
      for (const auto& critical : found) EXPECT_TRUE(critical.converged);
      expectCounts(family, found, top);
    }
}

}  // namespace
}  // namespace squeal
