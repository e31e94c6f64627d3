// SPDX-License-Identifier: BSD-2-Clause
// Condition numbers of eigenvalues against the eigenvalues of perturbed matrices, and of multiple
// ones by hand.
#include "eigen/reduction/condition.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "algebra/linalg/quadratic.hpp"
#include "support/algebra/dense.hpp"
#include "support/eigen/spectrum.hpp"

namespace squeal {
namespace {

using test::Complex;

linalg::DenseMatrix randomMatrix(PetscInt m, double diagonal, double rise, double size,
                                 std::mt19937& generator) {
  linalg::DenseMatrix matrix(m, m);
  for (PetscInt j = 0; j < m; ++j)
    for (PetscInt i = 0; i < m; ++i)
      matrix(i, j) = (i == j ? diagonal + rise * i : 0) + size * test::uniform(generator);
  return matrix;
}

Complex nearest(const std::vector<linalg::DensePair>& pairs, Complex s) {
  Complex best = INFINITY;
  for (const auto& pair : pairs)
    if (!(std::abs(pair.s - s) > std::abs(best - s))) best = pair.s;
  return best;
}

// P + ε Re(y dᴴ) moves s by ε yᴴ Re(y dᴴ) d / (yᴴP'd) = ε (1 + conj(yᵀy) dᵀd)/2 / (yᴴP'd): for real
// vectors that is the largest change a perturbation of this norm can make, κ ε |s|. Differences
// with ε = 1e-5: ε² from truncation; from rounding of s, 1e-15 |s|, over 2 ε κ |s| with κ = 0.01 at
// least, 1e-8.
TEST(Condition, AgainstPerturbedMatrices) {
  constexpr int m = 9;
  std::mt19937 generator(11);
  for (const bool damped : {false, true}) {
    linalg::DenseProblem problem{
        randomMatrix(m, 3, 0, 0.3, generator), {}, randomMatrix(m, 10, 7, 4, generator)};
    if (damped) problem.damping = randomMatrix(m, 0.5, 0.1, 0.5, generator);
    const auto pairs = linalg::solveQuadratic(problem, linalg::Vectors::both);
    const auto numbers = reduction::conditionNumbers(problem, pairs);
    ASSERT_EQ(numbers.size(), pairs.size());
    ASSERT_EQ(pairs.size(), static_cast<std::size_t>(m));
    int complex = 0;
    double worst = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto &d = pairs[k].q, &y = pairs[k].left;
      Complex yy = 0, dd = 0;
      for (int i = 0; i < m; ++i) yy += y[i] * y[i];
      for (int i = 0; i < m; ++i) dd += d[i] * d[i];
      const double part = std::abs(1.0 + std::conj(yy) * dd) / 2, step = 1e-5;
      complex += part < 0.99;
      Complex moved[2];
      for (const int side : {0, 1}) {
        linalg::DenseProblem there = problem;
        for (PetscInt j = 0; j < m; ++j)
          for (PetscInt i = 0; i < m; ++i)
            there.stiffness(i, j) += (side == 0 ? -step : step) * (y[i] * std::conj(d[j])).real();
        moved[side] = nearest(linalg::solveQuadratic(there), pairs[k].s);
      }
      const double wanted =
          std::abs(moved[1] - moved[0]) / (2 * step * std::abs(pairs[k].s) * part);
      worst = test::worse(worst, std::abs(numbers[k] / wanted - 1));
      EXPECT_NEAR(numbers[k], wanted, 1e-6 * wanted) << "s = " << pairs[k].s;
    }
    test::print("%s: condition numbers off by %.1e, %d of %d with complex vectors\n",
                damped ? "damped" : "undamped", worst, complex, m);
    EXPECT_GT(complex, 0);  // both kinds are there
    EXPECT_LT(complex, m);
  }
}

std::vector<Complex> unitVector(std::size_t m, std::size_t i) {
  std::vector<Complex> e(m);
  e[i] = 1;
  return e;
}

// M = I, K = diag(4, 4, 9). The vectors of s = 2i, twice, may be any: also e1 with e2 on the left,
// where yᴴP'd = 0. The matrix of all four products, 4i times [1 0; 0 1] or [0 1; 1 0], has the
// singular value 4 either way: 2/4/|s|. The other eigenvalue has 1/6/3.
TEST(Condition, OfADoubleEigenvalue) {
  const linalg::DenseProblem problem{
      test::identity(3), {}, test::diagonal(std::vector{4., 4., 9.})};
  const auto pair = [](double w, std::size_t right, std::size_t left) {
    return linalg::DensePair{{0, w}, unitVector(3, right), unitVector(3, left)};
  };
  for (const bool crossed : {false, true}) {
    const auto numbers = reduction::conditionNumbers(
        problem, {pair(2, 0, crossed), pair(2, 1, !crossed), pair(3, 2, 2)});
    ASSERT_EQ(numbers.size(), 3U);
    EXPECT_NEAR(numbers[0], 1. / 4, 1e-15);
    EXPECT_NEAR(numbers[1], 1. / 4, 1e-15);
    EXPECT_NEAR(numbers[2], 1. / 18, 1e-15);
  }
}

// X diag(4, 4, 9) X⁻¹ by LAPACK: whichever vectors it finds, perturbations of norm ε move both
// eigenvalues by κ ε |s| at most, and κ is not large: the condition number of X is about 4.
TEST(Condition, BoundsTheMovesOfADoubleEigenvalue) {
  const auto x = test::square({1, 0, 0, 1, 1, 0, 0.5, -1, 1}),
             inverse = test::square({1, 0, 0, -1, 1, 0, -1.5, 1, 1});
  const linalg::DenseProblem problem{
      test::identity(3),
      {},
      linalg::product(linalg::product(x, test::diagonal(std::vector{4., 4., 9.})), inverse)};
  const auto pairs = linalg::solveQuadratic(problem, linalg::Vectors::both);
  const auto numbers = reduction::conditionNumbers(problem, pairs);
  ASSERT_EQ(pairs.size(), 3U);
  std::mt19937 generator(5);
  const double step = 1e-7;
  for (int trial = 0; trial < 30; ++trial) {
    linalg::DenseProblem there = problem;
    const auto change = test::randomMatrix(3, 3, generator);
    double norm = 0;  // Frobenius: at least the 2-norm
    for (const double entry : change.entries()) norm += entry * entry;
    linalg::addScaled(there.stiffness, step / std::sqrt(norm), change);
    const auto moved = linalg::solveQuadratic(there);
    for (std::size_t j = 0; j < 2; ++j)
      for (const auto& pair : moved)
        if (std::abs(pair.s - Complex(0, 2)) < 0.1) {
          EXPECT_LT(std::abs(pair.s - pairs[j].s) / 2, 1.01 * numbers[j] * step);
        }
  }
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_NEAR(std::abs(pairs[j].s - Complex(0, 2)), 0, 1e-14);
    EXPECT_GT(numbers[j], 1. / 8 * (1 - 1e-12));  // of a symmetric matrix
    EXPECT_LT(numbers[j], 4);
  }
}

// K = [4 1; 0 4]: one right vector, e1, one left, e2, and e2ᵀ e1 = 0. LAPACK's vectors miss each
// other by rounding, no more.
TEST(Condition, OfADefectiveEigenvalueIsInfinite) {
  const linalg::DenseProblem problem{test::identity(2), {}, test::square({4, 0, 1, 4})};
  const linalg::DensePair pair{{0, 2}, unitVector(2, 0), unitVector(2, 1)};
  for (const double number : reduction::conditionNumbers(problem, {pair}))
    EXPECT_EQ(number, INFINITY);
  for (const double number : reduction::conditionNumbers(problem, {pair, pair}))
    EXPECT_EQ(number, INFINITY);
  const auto computed = linalg::solveQuadratic(problem, linalg::Vectors::both);
  EXPECT_EQ(computed.size(), 2U);
  for (const double number : reduction::conditionNumbers(problem, computed)) EXPECT_GT(number, 1e7);
}

}  // namespace
}  // namespace squeal
