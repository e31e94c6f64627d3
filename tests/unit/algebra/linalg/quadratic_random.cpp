// SPDX-License-Identifier: BSD-2-Clause
// Dense quadratic problems of random matrices: sums of powers of all eigenvalues, left vectors,
// overlaps, and the time that a large problem takes.
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <random>

#include "algebra/linalg/quadratic.hpp"
#include "algebra/linalg/rayleigh_ritz.hpp"
#include "algebra/linalg/spread.hpp"
#include "support/algebra/dense.hpp"
#include "support/algebra/quadratic.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using linalg::DenseMatrix;
using linalg::DenseProblem;
using test::randomMatrix;

/// Multiplies the rows by factors that go from 1 to nearly `last`.
void scaleRows(DenseMatrix& a, double last) {
  for (PetscInt j = 0; j < a.columns(); ++j)
    for (PetscInt i = 0; i < a.rows(); ++i)
      a(i, j) *= std::pow(last, static_cast<double>(i) / a.rows());
}

// By QR and by QZ, with damping and without, from rank 0 to all.
TEST(Quadratic, LeftVectors) {
  constexpr PetscInt m = 40;
  std::mt19937 generator(11);
  const DenseMatrix damping = randomMatrix(m, m, generator, 0.3),
                    stiffness = randomMatrix(m, m, generator, 4.0 * m),
                    plain = randomMatrix(m, m, generator, 3.0 * m);
  for (const double spread : {1.0, 1e6})
    for (const auto& z : {damping, DenseMatrix()}) {
      DenseProblem problem{plain, z, stiffness};
      scaleRows(problem.mass, 1 / spread);
      const auto pairs = linalg::solveTogether(PETSC_COMM_WORLD, problem, linalg::Vectors::both);
      const auto right = linalg::solveTogether(PETSC_COMM_WORLD, problem);
      EXPECT_EQ(pairs.size(), right.size());
      EXPECT_TRUE(right.front().left.empty());
      EXPECT_LT(test::worstResidual(problem, pairs), 1e-13);
      EXPECT_LT(test::worstLeftResidual(problem, pairs), 1e-13);
    }
}

/// Returns the problem in one more unknown that is coupled weakly to the others.
DenseProblem enlarged(const DenseProblem& problem) {
  const PetscInt m = problem.order();
  DenseProblem result;
  for (const auto matrix :
       {&DenseProblem::mass, &DenseProblem::damping, &DenseProblem::stiffness}) {
    if ((problem.*matrix).empty()) continue;
    DenseMatrix& large = result.*matrix;
    large = DenseMatrix(m + 1, m + 1);
    linalg::addExtended(large, 1, problem.*matrix);
    large(m, m) = 30;
    large(m, 0) = large(0, m) = 0.1;
  }
  return result;
}

// The projectors of one problem are disjoint. All overlaps together, also with a problem of a
// larger basis, are those of single pairs.
TEST(Spectrum, AllOverlaps) {
  constexpr PetscInt m = 12;
  std::mt19937 generator(7);
  const DenseMatrix mass = randomMatrix(m, m, generator, 3.0 * m),
                    damping = randomMatrix(m, m, generator, 0.3),
                    stiffness = randomMatrix(m, m, generator, 4.0 * m);
  for (const auto& z : {damping, DenseMatrix()}) {
    const DenseProblem problem{mass, z, stiffness}, larger = enlarged(problem);
    const linalg::Spectrum small(problem, solveQuadratic(problem, linalg::Vectors::both)),
        large(larger, solveQuadratic(larger, linalg::Vectors::both));
    const auto own = small.overlaps(small);
    for (PetscInt j = 0; j < own.columns(); ++j)
      for (PetscInt i = 0; i < own.rows(); ++i)
        EXPECT_NEAR(std::abs(own(i, j) - Complex(i == j)), 0, 1e-11) << i << ' ' << j;
    for (const auto& [from, to] : {std::pair(&small, &large), std::pair(&large, &small)}) {
      const auto all = from->overlaps(*to);
      ASSERT_EQ(all.columns(), std::ssize(to->pairs()));
      for (PetscInt j = 0; j < all.columns(); ++j)
        for (PetscInt i = 0; i < all.rows(); ++i)
          EXPECT_NEAR(std::abs(all(i, j) - from->overlap(i, *to, j)), 0, 1e-12);
    }
  }
}

double trace(const DenseMatrix& a) {
  double sum = 0;
  for (PetscInt i = 0; i < a.rows(); ++i) sum += a(i, i);
  return sum;
}

/// Sums of the first three powers of all 2m eigenvalues, for M = I:
///   Σ s = −tr Z,  Σ s² = tr Z² − 2 tr K,  Σ s³ = −tr Z³ + 3 tr Z K.
/// One eigenvalue missed, or found twice, shows in all of them.
struct PowerSums {
  double sum[3] = {0, 0, 0};
  double size[3] = {0, 0, 0};  ///< the same of |s|
};

PowerSums exactSums(const DenseMatrix& damping, const DenseMatrix& stiffness) {
  const DenseMatrix square = linalg::product(damping, damping),
                    cube = linalg::product(square, damping),
                    mixed = linalg::product(damping, stiffness);
  return {{-trace(damping), trace(square) - 2 * trace(stiffness), -trace(cube) + 3 * trace(mixed)},
          {}};
}

PowerSums foundSums(const std::vector<linalg::DensePair>& pairs) {
  PowerSums found;
  for (const auto& pair : pairs)
    for (int power = 1; power <= 3; ++power) {
      const int times = pair.s.imag() == 0 ? 1 : 2;  // s and its conjugate
      found.sum[power - 1] += times * std::pow(pair.s, power).real();
      found.size[power - 1] += times * std::pow(std::abs(pair.s), power);
    }
  return found;
}

void expectPowerSums(const std::vector<linalg::DensePair>& pairs, const DenseProblem& problem,
                     double tolerance) {
  const PowerSums exact = exactSums(problem.damping, problem.stiffness), found = foundSums(pairs);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(found.sum[k], exact.sum[k], tolerance * found.size[k]) << "power " << k + 1;
}

// Damped, gyroscopic and circulatory forces at once. P and D P have the same eigenvalues; D with
// entries from 1 to 1e6 makes the mass ill-conditioned, which takes the way of QZ.
TEST(Quadratic, NoEigenvalueIsMissed) {
  std::mt19937 generator(5);
  for (const PetscInt m : {60, 150}) {
    const DenseProblem problem{test::identity(m), randomMatrix(m, m, generator, 0.3),
                               randomMatrix(m, m, generator, 4.0 * m)};
    const auto pairs = linalg::solveQuadratic(problem);
    expectPowerSums(pairs, problem, 1e-13);
    EXPECT_LT(test::worstResidual(problem, pairs), 1e-13);
    DenseProblem scaled = problem;
    for (auto* matrix : {&scaled.mass, &scaled.damping, &scaled.stiffness}) scaleRows(*matrix, 1e6);
    // Backward errors of QZ are relative to the largest rows, 1e6 times the smallest.
    test::expectSpectrum(test::eigenvaluesOf(linalg::solveQuadratic(scaled)),
                         test::eigenvaluesOf(pairs), 1e-8);
  }
}

// The size of the reduced problem of a brake after its corrections.
TEST(Quadratic, LargeProblem) {
  constexpr PetscInt m = 500;
  std::mt19937 generator(9);
  const DenseProblem problem{test::identity(m), randomMatrix(m, m, generator, 0.1),
                             randomMatrix(m, m, generator, 8.0 * m)};
  const auto start = std::clock();
  const auto pairs = linalg::solveQuadratic(problem);
  test::print("all eigenvalues of a quadratic problem of size %d: %.2f s of processor time\n",
              static_cast<int>(m), static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  expectPowerSums(pairs, problem, 1e-13);
}

}  // namespace
}  // namespace squeal
