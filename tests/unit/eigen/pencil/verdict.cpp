// SPDX-License-Identifier: BSD-2-Clause
// The verdicts follow from growth rates and errors that are known.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "eigen/pencil/complex_modes.hpp"

namespace squeal::pencil {
namespace {

constexpr Criteria plain{.accuracy = 1e-9, .shapes = 3, .shapesBelow = 1e9};

/// Returns the verdicts on eigenvalues of a band up to 1000 rad/s, all with the same estimate of
/// |δs|/|s|.
std::vector<Verdict> verdicts(const std::vector<Complex>& values, double estimate,
                              Symmetry symmetry, const Criteria& criteria = plain) {
  ComplexModes point;
  point.bandTop = 1000;
  for (const Complex s : values) point.eigenvalues.push_back({s, 0, estimate * std::abs(s), true});
  setVerdicts(point, symmetry, criteria);
  std::vector<Verdict> found;
  for (const auto& e : point.eigenvalues) {
    found.push_back(e.verdict);
    EXPECT_EQ(e.unstable, e.verdict == Verdict::unstable) << e.s;
  }
  return found;
}

using enum Verdict;
using List = std::vector<Verdict>;

TEST(Verdict, FollowsFromGrowthAndError) {
  // The error is 1e-3 · 500 = 0.5 1/s.
  EXPECT_EQ(
      verdicts({{0.6, 500}, {0.4, 500}, {0, 500}, {-0.4, 500}, {-0.6, 500}}, 1e-3, Symmetry::none),
      (List{unstable, undecided, undecided, undecided, stable}));
}

// A simple eigenvalue of a real problem in s² stays on the imaginary axis under any small change;
// two that are as near as their errors may part into a growing and a decaying one.
TEST(Verdict, IsolatedEigenvaluesOfAnEvenProblemAreNeutral) {
  const std::vector<Complex> near{{0, 500}, {0, 500.9}, {0, 700}}, apart{{0, 500}, {0, 502}};
  EXPECT_EQ(verdicts(near, 1e-3, Symmetry::even), (List{undecided, undecided, neutral}));
  EXPECT_EQ(verdicts(apart, 1e-3, Symmetry::even), (List{neutral, neutral}));
  EXPECT_EQ(verdicts(apart, 1e-3, Symmetry::none), (List{undecided, undecided}));
  // s and −conj s are not apart by more than their errors: they may be two neutral ones.
  EXPECT_EQ(verdicts({{-0.4, 500}, {0.4, 500}}, 1e-3, Symmetry::even),
            (List{undecided, undecided}));
  EXPECT_EQ(verdicts({{-0.6, 500}, {0.6, 500}}, 1e-3, Symmetry::even), (List{stable, unstable}));
  // Nothing is known beyond the top of the band, and nothing of an eigenvalue as small as its
  // error.
  EXPECT_EQ(verdicts({{0, 1e-6}, {0, 999}}, 1e-3, Symmetry::even), (List{neutral, undecided}));
  EXPECT_EQ(verdicts({{0, 1e-6}}, 1.1, Symmetry::even), (List{undecided}));
}

TEST(Verdict, EqualEigenvaluesOfAConservativeProblemAreNeutral) {
  EXPECT_EQ(verdicts({{0, 500}, {0, 500}, {0, 999}}, 1e-3, Symmetry::conservative),
            (List{neutral, neutral, neutral}));
}

TEST(Verdict, MayAskForMoreThanGrowth) {
  Criteria demanding = plain;
  demanding.unstable = 0.01;  // of |s| = 500: 5 1/s
  EXPECT_EQ(verdicts({{5.6, 500}, {5.4, 500}, {4.6, 500}, {4.4, 500}, {0, 500}}, 1e-3,
                     Symmetry::none, demanding),
            (List{unstable, undecided, undecided, stable, stable}));
}

TEST(Verdict, IsNotGivenWithoutAnEstimate) {
  ComplexModes point;
  // Growth of 1e-6 |s| is taken as rounding.
  for (const Complex s : {Complex(-1, 500), Complex(4e-4, 500), Complex(6e-4, 500)})
    point.eigenvalues.push_back({s, 0, NAN, true});
  EXPECT_EQ(point.verdict(), uncertified);
  setVerdicts(point, Symmetry::conservative, plain);
  EXPECT_EQ(point.count(uncertified), 3);
  EXPECT_EQ(point.unstableCount(), 1);
  EXPECT_TRUE(point.eigenvalues[2].unstable);
  EXPECT_EQ(point.verdict(), uncertified);
}

TEST(Verdict, OfAPointIsThatOfItsWorstEigenvalue) {
  ComplexModes point;
  const auto with = [&](Verdict verdict) {
    point.eigenvalues.push_back({});
    point.eigenvalues.back().verdict = verdict;
    return point.verdict();
  };
  EXPECT_EQ(point.verdict(), uncertified);
  for (const Verdict one : {stable, neutral, undecided, uncertified, unstable})
    EXPECT_EQ(with(one), one);
}

}  // namespace
}  // namespace squeal::pencil
