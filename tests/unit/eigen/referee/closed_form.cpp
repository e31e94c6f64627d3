// SPDX-License-Identifier: BSD-2-Clause
// The referee on a problem whose eigenvalues are the roots of a sum:
//   K = diag(j²) + f Sᵀ N,  M = 1,  C = α,  S = (1, 1, …),  N = ((−1)^j),  j = 1 … n,
//   det = Π (j² + w) (1 + f Σ (−1)^j / (j² + w)),  w = s² + α s.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "base/system/error.hpp"
#include "eigen/proof/matrix_bounds.hpp"
#include "eigen/referee/kept_space.hpp"
#include "eigen/referee/referee.hpp"
#include "support/algebra/dense.hpp"

namespace {

using namespace squeal;
using referee::Verdict;

constexpr int size = 120;
constexpr double top = 5.5;

/// Collective. Returns a full matrix, or only its diagonal.
template <class Entry>
OwnedMat matrix(const Entry& entry, bool diagonal = false) {
  OwnedMat result;
  const int row = diagonal ? 1 : size;
  check(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, size, size, row, nullptr, row,
                     nullptr, result.out()));
  PetscInt first = 0, end = 0;
  check(MatGetOwnershipRange(result, &first, &end));
  for (PetscInt i = first; i < end; ++i)
    for (PetscInt j = diagonal ? i : 0; j < (diagonal ? i + 1 : size); ++j)
      check(MatSetValue(result, i, j, entry(i + 1, j + 1), INSERT_VALUES));
  check(MatAssemblyBegin(result, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(result, MAT_FINAL_ASSEMBLY));
  return result;
}

pencil::Pencil pencilOf(double friction, double alpha) {
  std::vector<pencil::Term> terms(2);
  terms[0].matrix = matrix(
      [=](int i, int j) { return friction * (j % 2 ? -1 : 1) + (i == j ? 1.0 * i * i : 0); });
  terms[1].matrix = matrix([](int, int) { return 1.0; }, true);
  terms[1].power = 2;
  if (alpha > 0) {
    terms.emplace_back();
    terms[2].matrix = matrix([=](int, int) { return alpha; }, true);
    terms[2].power = 1;
  }
  return pencil::Pencil(std::move(terms));
}

/// Returns the root w near a start, by the secant method.
Complex root(double friction, Complex w) {
  const auto determinant = [=](Complex x) {
    Complex sum = 1;
    for (int j = 1; j <= size; ++j) sum += friction * (j % 2 ? -1.0 : 1.0) / (x + 1.0 * j * j);
    return sum;
  };
  Complex before = w * (1.0 + 1e-6);
  for (int i = 0; i < 30 && std::abs(w - before) > 1e-14 * std::abs(w); ++i) {
    const Complex slope = (determinant(w) - determinant(before)) / (w - before);
    before = w;
    w -= determinant(w) / slope;
  }
  return w;
}

/// Returns the eigenvalues with Im s ≥ 0 in |s| < 5.5 at friction 4. The starts are the roots for
/// infinitely many unknowns.
std::vector<Complex> eigenvalues(double alpha) {
  std::vector<Complex> list;
  for (const Complex start : {Complex(1.317626572, 0), Complex(0.399889816, 2.531435478),
                              Complex(0.227636476, 4.521430743)}) {
    const Complex w = root(4, start * start), half = std::sqrt(w + alpha * alpha / 4);
    for (const Complex sign : {1.0, -1.0}) {
      Complex s = sign * half - alpha / 2;
      if (s.imag() < 0) s = std::conj(s);
      list.push_back(s);
    }
  }
  return list;
}

referee::Judgement judged(const std::vector<Complex>& list, double alpha,
                          referee::Settings settings = {}) {
  const auto pencil = pencilOf(4, alpha);
  return referee::judge({pencil, {}}, list, settings, {});
}

// K has a negative eigenvalue, so σ > 0. A root of the sum is an eigenvalue to round-off.
TEST(Referee, CompleteListIsRight) {
  for (const double alpha : {0.0, 0.05}) {
    const auto list = eigenvalues(alpha);
    referee::Settings settings{.top = top, .tolerance = 1e-8};
    // All of them: −Re s up to 1.34
    if (alpha > 0) settings.left = 0.3;
    const auto found = judged(list, alpha, settings);
    EXPECT_TRUE(found.isComplete()) << found.sentence();
    EXPECT_GT(found.sizes.shift, 0);
    EXPECT_LT(found.sizes.basis, size);  // something is left out
    EXPECT_EQ(found.count.count, 10);
    EXPECT_EQ(found.number(Verdict::right), 6);
    for (const auto& row : found.rows) {
      EXPECT_LE(row.distance, row.radius + 1e-10);
      EXPECT_LT(row.radius, 1e-6);
    }
  }
}

TEST(Referee, FaultsAreNamed) {
  auto list = eigenvalues(0);
  const Complex gone = list[2], moved = list[4];
  list.erase(list.begin() + 2);
  list[3] += Complex(1e-3, 0);
  list.push_back(list[0]);
  list.emplace_back(0, 3.3);
  list.emplace_back(0, 6);
  const auto found = judged(list, 0, {.top = top});
  ASSERT_TRUE(found.proved()) << found.why;
  const std::vector expected{Verdict::right,    Verdict::right,   Verdict::right,
                             Verdict::inexact,  Verdict::right,   Verdict::repeated,
                             Verdict::artefact, Verdict::outside, Verdict::missing};
  ASSERT_EQ(found.rows.size(), expected.size()) << found.sentence();
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_STREQ(text(found.rows[i].verdict), text(expected[i])) << i;
  EXPECT_LE(std::abs(*found.rows[8].proved - gone), found.rows[8].radius + 1e-10);
  EXPECT_LE(std::abs(*found.rows[3].proved - moved), found.rows[3].radius + 1e-10);
  EXPECT_NEAR(found.rows[3].distance, 1e-3, 1e-6);
  EXPECT_FALSE(found.isComplete());
}

// Without -referee_top the region ends above the list: the eigenvalues beyond are not missing.
TEST(Referee, RegionOfAPartOfTheList) {
  auto list = eigenvalues(0);
  list.resize(4);
  const auto found = judged(list, 0);
  EXPECT_TRUE(found.isComplete()) << found.sentence();
  EXPECT_EQ(found.count.count, 6);
  EXPECT_GT(found.region.top, std::abs(list[3]));
  EXPECT_LT(found.region.top, 4.521);
}

// With too few modes the rest is not bounded, and nothing is claimed.
TEST(Referee, TooFewModesProveNothing) {
  modes::Settings few;
  const auto pencil = pencilOf(4, 0);
  const auto found = referee::judge({pencil, {}}, eigenvalues(0), {.top = top}, few.withCount(5));
  EXPECT_FALSE(found.proved());
  EXPECT_EQ(found.count.verdict, proof::Verdict::indefinite);
  EXPECT_EQ(found.number(Verdict::unproved), 6) << found.sentence();
}

// C = α M has the norm α / θ on the rest, and G with entries ±g between neighbours at most 2 g
// (K + θ)⁻¹.
TEST(Referee, BoundsOfOtherTermsHold) {
  const double alpha = 0.05, theta = 100, g = 0.05;  // large enough to matter
  std::vector<pencil::Term> terms(3);
  terms[0].matrix = matrix([](int i, int) { return 1.0 * i * i; }, true);
  terms[1].matrix = matrix([](int, int) { return 1.0; }, true);
  terms[1].power = 2;
  terms[2].matrix = matrix([=](int i, int j) {
    return i == j ? alpha : j == i + 1 ? g : j == i - 1 ? -g : 0;
  });
  terms[2].power = 1;
  const pencil::Pencil pencil(std::move(terms));
  const referee::SplitProblem problem(pencil, {});
  const auto shifted = referee::shiftedSystem(problem, top);
  EXPECT_EQ(shifted.shift, 0);
  const Mat damping = problem.symmetric(1), gyroscopic = problem.skew(1);
  const proof::MatrixBounds bounds(shifted.system, 1 / theta, {damping, gyroscopic, nullptr});
  const auto [whole, below] = bounds.ofDamping(damping, top, top);
  // 2 max α / (j² + θ) is at j = 1; the bound is less than 1.2 times as large.
  for (const double bound : {whole, bounds.ofSymmetric(damping, top)}) {
    EXPECT_GE(bound, 2 * alpha / (1 + theta) * (1 - 1e-12));
    EXPECT_LE(bound, 2.4 * alpha / (1 + theta));
  }
  EXPECT_LE(below, 1e-8 * whole);
  const double ofSkew = bounds.ofSkew(gyroscopic, top);
  EXPECT_GE(ofSkew, g / theta);  // of one pair
  EXPECT_LE(ofSkew, 2.4 * 2 * g / (1 + theta));
  EXPECT_EQ(bounds.ofSkew(nullptr, top), 0);
}

// K is triangular, with the eigenvalues j², and couples the lowest unknown to the highest by c. The
// lowest eigenvalue of K_s is that of [1, c/2; c/2, 120²], and σ must be larger: 5121 with c = 2e4,
// 43,317 with c = 1e5. The largest σ tried is 256 · 5.5² = 7744.
TEST(Referee, LargeShifts) {
  const auto judgedWith = [](double c) {
    std::vector<pencil::Term> terms(2);
    terms[0].matrix = matrix([=](int i, int j) {
      return i == j ? 1.0 * i * i : i == 1 && j == size ? c : 0;
    });
    terms[1].matrix = matrix([](int, int) { return 1.0; }, true);
    terms[1].power = 2;
    const pencil::Pencil pencil(std::move(terms));
    return referee::judge({pencil, {}}, std::vector<Complex>{{0, 1}, {0, 2}}, {.top = top}, {});
  };
  const auto found = judgedWith(2e4);
  EXPECT_GT(found.sizes.shift, 5121);
  EXPECT_TRUE(!found.proved() || found.count.count == 10) << found.sentence();
  try {
    judgedWith(1e5);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("the unsymmetric part is too large"),
              std::string::npos)
        << error.what();
  }
}

TEST(Referee, IndefiniteMassIsRefused) {
  std::vector<pencil::Term> terms(2);
  terms[0].matrix = matrix([](int, int) { return 1.0; }, true);
  terms[1].matrix = matrix([](int i, int) { return i == 3 ? -1.0 : 1.0; }, true);
  terms[1].power = 2;
  const pencil::Pencil pencil(std::move(terms));
  try {
    referee::SplitProblem(pencil, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("1 negative"), std::string::npos) << error.what();
  }
}

}  // namespace
