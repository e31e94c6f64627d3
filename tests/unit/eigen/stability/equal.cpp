// SPDX-License-Identifier: BSD-2-Clause
// Equal eigenvalues, at an end of a step or within it, against closed forms: they hide no change of
// stability, and what cannot be decided is reported.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "algebra/linalg/quadratic.hpp"
#include "algebra/linalg/rayleigh_ritz.hpp"
#include "algebra/linalg/spread.hpp"
#include "eigen/stability/critical.hpp"
#include "eigen/tracking/join.hpp"
#include "eigen/tracking/track.hpp"
#include "support/algebra/dense.hpp"
#include "support/eigen/friction_families.hpp"

namespace squeal {
namespace {

using test::diagonal;
using test::expectNoGaps;
using test::grid;
using test::identity;
using test::Linear;
using test::modal;
using tracking::Event;

using List = std::vector<double>;

/// Adds f Z1 to the damping and f² K2 to the stiffness, or another function than f².
struct Bent : Linear {
  linalg::DenseMatrix damping, second;
  Bent(Linear linear, linalg::DenseMatrix z1, linalg::DenseMatrix k2)
      : Linear(std::move(linear)), damping(std::move(z1)), second(std::move(k2)) {}
  std::optional<linalg::DenseProblem> at(double f) override {
    auto problem = *Linear::at(f);
    if (!damping.empty()) linalg::addScaled(problem.damping, f, damping);
    if (!second.empty()) linalg::addScaled(problem.stiffness, power(f), second);
    return problem;
  }
  virtual double power(double f) const { return f * f; }
};

struct Cubic : Bent {
  using Bent::Bent;
  double power(double f) const override { return std::pow(f - 0.4, 3); }
};

std::vector<stability::Critical> solved(tracking::Family& family, const List& frictions) {
  const auto branches = track(family, frictions, {});
  expectNoGaps(branches);
  return stability::criticalFrictions(family, branches, 1e-9);
}

// Two modes of ω² = 4 and 5 with equal damping c and coupling f. The eigenvalues of K, 9/2 ± √(1/4
// − f²), are equal at f = 1/2, and so are those of both modes, with the growth −c/2. Beyond, s = iω
// with ω² = 9/2 and (ω c)² = f² − 1/4 is where the growth is zero.
TEST(Equal, FrictionsOfTheSweepAndPointsBetweenThem) {
  for (const double c : {0.1, 1e-2, 1e-3, 1e-4, 1e-5}) {
    Linear family = modal({4, 5}, {{0, 1, 1}}, {c, c});
    const double exact = std::sqrt(0.25 + 4.5 * c * c);
    for (const List& frictions : {List{0, 1},
                                  {0, 2},
                                  {0, 0.9},
                                  {0.1, 1},
                                  {0, 0.5, 1},
                                  {0.5, 1},
                                  {0, 0.25, 0.5, 0.75},
                                  {0.2, 0.8}}) {
      const auto found = solved(family, frictions);
      ASSERT_EQ(found.size(), 1u) << "damping " << c << " to " << frictions.back();
      EXPECT_TRUE(found[0].loss && found[0].converged);
      EXPECT_EQ(found[0].kind, Event::Kind::crossing);
      EXPECT_NEAR(found[0].friction, exact, 1e-12);
      EXPECT_LE(found[0].errorEstimate, 1e-11);
    }
    EXPECT_TRUE(solved(family, {0, 0.5}).empty());
  }
}

// So close to the friction where they are equal that it cannot be distinguished: reported as not
// converged, with an error that covers it.
TEST(Equal, ChangeTooCloseToBeSolvedFor) {
  const double c = 1e-6, exact = std::sqrt(0.25 + 4.5 * c * c);
  Linear family = modal({4, 5}, {{0, 1, 1}}, {c, c});
  for (const List& frictions : {List{0, 1}, {0, 0.9}, {0.5, 1}}) {
    const auto found = solved(family, frictions);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_TRUE(found[0].loss);
    EXPECT_LE(std::abs(found[0].friction - exact), found[0].errorEstimate + 1e-13);
    EXPECT_LT(found[0].errorEstimate, 1e-8);
  }
}

// The damping c − f makes both grow beyond f = c: with c < 1/2 below the friction where they are
// equal, on the other side of it.
TEST(Equal, ChangesBeforeTheyAreEqual) {
  for (const double c : {0.3, 0.1}) {
    Bent family(modal({4, 5}, {{0, 1, 1}}, {c, c}), diagonal(List{-1, -1}), {});
    for (const List& frictions : {List{0, 0.8}, {0, 1}, {0, 0.5}, {0, 0.5, 1}, {0, 0.9}}) {
      const auto found = solved(family, frictions);
      int change = 0;
      for (const auto& critical : found) change += critical.loss ? 1 : -1;
      ASSERT_GE(found.size(), 2u);
      EXPECT_EQ(change, 2);
      EXPECT_NEAR(found[0].friction, c, 1e-10);
      EXPECT_NEAR(found[1].friction, c, 1e-10);
    }
  }
}

// Modes that are equal throughout cross together at f = 0.3.
TEST(Equal, CrossingTogether) {
  Bent family(modal({4, 4}, {}, {0.3, 0.3}), diagonal(List{-1, -1}), {});
  const auto found = solved(family, {0, 1});
  ASSERT_EQ(found.size(), 2u);
  for (const auto& critical : found) {
    EXPECT_NEAR(critical.friction, 0.3, 1e-10);
    EXPECT_TRUE(critical.loss && critical.converged);
  }
}

// K = 100 I + f [1 1/2; −1/2 −1] + f² [0 0; 0 1]: with half differences of ω², (f − f²/2)² − f²/4,
// the modes part at f = 0 as neutral ones and merge at f = 1. Without the first matrix but its
// coupling they are unstable from 0 on.
TEST(Equal, PartAtOnceOrMergeLater) {
  linalg::DenseMatrix slope = diagonal(List{1, -1});
  slope(0, 1) = 0.5;
  slope(1, 0) = -0.5;
  Bent later({{identity(2), {}, diagonal(List{100, 100})}, slope}, {}, diagonal(List{0, 1}));
  for (const List& frictions : {List{0, 1.5}, {0, 2}, {0, 0.5, 1.5}}) {
    const auto found = solved(later, frictions);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_TRUE(found[0].loss && found[0].converged);
    EXPECT_EQ(found[0].kind, Event::Kind::coalescence);
    EXPECT_NEAR(found[0].friction, 1, 1e-10);
  }
  // The frequency is that where they are equal, at either end of the step.
  Linear once = modal({100, 100}, {{0, 1, 0.5}}), back = once;
  linalg::addScaled(back.base.stiffness, 1, once.friction);
  linalg::addScaled(back.friction, -2, once.friction);
  for (Linear* family : {&once, &back}) {
    const auto found = solved(*family, {0, 1});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].friction, family == &once ? 0 : 1);
    EXPECT_EQ(found[0].loss, family == &once);
    EXPECT_NEAR(found[0].angularFrequency, 10, 1e-6);  // √round-off of equal eigenvalues
  }
}

// K = k I + f [0 c; 0 0] has two equal eigenvalues at all frictions, with one vector.
TEST(Equal, DefectiveThroughout) {
  for (const double k : {1.0, 4.0, 7.3})
    for (const double c : {1.0, -1.0, 3.7, 100.0})
      for (const int steps : {1, 2, 4, 10}) {
        linalg::DenseMatrix slope(2, 2);
        slope(0, 1) = c;
        for (const List& damping : {List{}, List{0.1, 0.1}}) {
          Linear family({identity(2), diagonal(damping), diagonal(List{k, k})}, slope);
          const auto branches = track(family, grid(1, steps), {});
          // With damping, rounding may part them by more than what counts as equal.
          if (damping.empty()) expectNoGaps(branches);
          EXPECT_TRUE(branches.events.empty())
              << "k " << k << ", c " << c << ", " << steps << " steps";
        }
      }
}

// Two modes cross at f = 0.4, where the difference of their ω² is 100 (f − 0.4)³. With the coupling
// c they are unstable while |f − 0.4|³ < c/50. What parabolas do not find there is reported.
TEST(Equal, FlatMergerIsFoundOrTold) {
  for (const double c : {1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    Linear family = modal({100, 100}, {});
    family.base.stiffness(0, 1) = c;
    family.base.stiffness(1, 0) = -c;
    Cubic flat(family, {}, diagonal(List{100, 0}));
    const auto branches = track(flat, {0, 1}, {});
    if (branches.gaps.empty()) {
      const auto found = stability::criticalFrictions(flat, branches, 1e-9);
      ASSERT_EQ(found.size(), 2u) << c;
      EXPECT_NEAR(found[0].friction, 0.4 - std::cbrt(c / 50), 1e-8);
      EXPECT_NEAR(found[1].friction, 0.4 + std::cbrt(c / 50), 1e-8);
    }
  }
}

// The projector of a defective pair is not known, and so it cannot be said what continues it.
TEST(Equal, NothingContinuesADefectivePair) {
  linalg::DenseProblem problem{identity(2), {}, diagonal(List{4, 9})};
  const linalg::DensePair pair{{0, 2}, {1, 0}, {0, 1}};
  const linalg::Spectrum from(problem, {pair}), to(problem, {{{0, 2}, {1, 0}, {1, 0}}, pair});
  EXPECT_FALSE(tracking::continuedIn(problem, from, {0, 2}, 1));
  const auto mate = tracking::assigned(from, to, {{0}, {0, 1}, 0});
  EXPECT_LT(mate[0], 2u);
}

/// The family asked for nothing outside a bracket.
struct Bracketed : Linear {
  double low = 0, high = 1;
  explicit Bracketed(Linear linear) : Linear(std::move(linear)) {}
  std::optional<linalg::DenseProblem> at(double f) override {
    EXPECT_TRUE(f >= low && f <= high) << f;
    return Linear::at(f);
  }
};

tracking::Branches crossingBetween(Linear& family, double low, double high) {
  Event event;
  event.low = low;
  event.high = high;
  event.isolation = 0.1;
  const auto growing = [&](double f) {
    auto pairs = linalg::solveTogether(PETSC_COMM_WORLD, *family.at(f), linalg::Vectors::both);
    std::sort(pairs.begin(), pairs.end(),
              [](const auto& a, const auto& b) { return a.s.real() > b.s.real(); });
    pairs.resize(1);
    return pairs;
  };
  event.below = growing(low);
  event.above = growing(high);
  tracking::Branches branches;
  branches.events.push_back(event);
  return branches;
}

// A bracket without a change of sign: the root is not sought outside.
TEST(Equal, BracketWithoutAChangeOfSign) {
  Bracketed family(modal({4, 5}, {{0, 1, 1}}, {0.1, 0.1}));
  const auto branches = crossingBetween(family, 0.55, 0.6);  // the root is 0.543
  family.low = 0.55;
  family.high = 0.6;
  const auto found = stability::criticalFrictions(family, branches, 1e-9);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found[0].converged);
  EXPECT_NEAR(found[0].errorEstimate, 0.025, 1e-12);
}

// A bracket so narrow that 1e-5 of it is below rounding of the friction: the root in it is kept.
TEST(Equal, NarrowBracket) {
  const double offset = 1e4, width = 1e-8, exact = offset + std::sqrt(0.295);
  Linear family = modal({4, 5}, {{0, 1, 1}}, {0.1, 0.1});
  linalg::addScaled(family.base.stiffness, -offset, family.friction);
  const auto branches = crossingBetween(family, exact - 0.2 * width, exact + 0.8 * width);
  const auto found = stability::criticalFrictions(family, branches, 1e-9);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].converged);
  EXPECT_NEAR(found[0].friction, exact, 0.05 * width);
}

}  // namespace
}  // namespace squeal
