// SPDX-License-Identifier: BSD-2-Clause
// Dense quadratic problems whose spectrum is known: proportional damping with multiple eigenvalues,
// overdamped modes, gyroscopic forces.
#include "algebra/linalg/quadratic.hpp"
#include "algebra/linalg/spread.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "support/algebra/dense.hpp"
#include "support/algebra/quadratic.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/model/model.hpp"

namespace squeal {
namespace {

using linalg::DenseMatrix;
using linalg::DenseProblem;
using linalg::solveQuadratic;
using test::eigenvaluesOf;
using test::expectSpectrum;
using test::identity;

// Without damping forces gyroscopic ones do no work: all eigenvalues stay on the imaginary axis.
TEST(Quadratic, GyroscopicForcesDoNoWork) {
  constexpr PetscInt m = 80;
  std::mt19937 generator(6);
  const DenseMatrix any = test::randomMatrix(m, m, generator);
  DenseProblem problem{identity(m), any, DenseMatrix(m, m)};
  linalg::addScaled(problem.damping, -1, linalg::transposed(any));
  for (PetscInt j = 0; j < m; ++j) problem.stiffness(j, j) = 1 + j * j;
  const auto pairs = solveQuadratic(problem);
  EXPECT_EQ(std::ssize(pairs), m);
  for (const auto& pair : pairs) EXPECT_LT(std::abs(pair.s.real()), 1e-11);
  EXPECT_LT(test::worstResidual(problem, pairs), 1e-13);
}

/// Returns Q diag(d) Qᵀ, full, with the reflection Q = I − 2 v vᵀ / vᵀv.
DenseMatrix reflected(const std::vector<double>& d, std::mt19937 generator) {
  const PetscInt m = std::ssize(d);
  const DenseMatrix v = test::randomMatrix(m, 1, generator);
  const double square = linalg::transposedProduct(v, v)(0, 0);
  DenseMatrix q = identity(m);
  linalg::multiplyAdd(v, linalg::transposed(v), q, -2 / square);
  return linalg::congruent(test::diagonal(d), q);
}

// Without damping, symmetric matrices have real s². Double frequencies, a stiffness without a sign
// and a mass without one direction: no growth comes from rounding, and left vectors are right ones.
TEST(Quadratic, SymmetricMatricesHaveRealSquares) {
  constexpr PetscInt m = 50;
  std::mt19937 generator(12);
  std::vector<double> squares, some(m, 1.0);
  for (PetscInt i = 0; i < m; ++i) squares.push_back(1e8 * (1 + i / 2));
  const auto both = linalg::Vectors::both;
  const DenseMatrix unit = reflected(some, generator);
  auto pairs = solveQuadratic({unit, {}, reflected(squares, generator)}, both);
  ASSERT_EQ(std::ssize(pairs), m);
  for (PetscInt j = 0; j < m; ++j) {
    EXPECT_EQ(pairs[j].s.real(), 0);
    EXPECT_NEAR(pairs[j].s.imag() / std::sqrt(squares[j]), 1, 1e-13);
    EXPECT_EQ(pairs[j].left, pairs[j].q);
  }
  some[3] = 0;  // no eigenvalue: this direction has no mass
  const DenseProblem massless{reflected(some, generator), {}, reflected(squares, generator)};
  pairs = solveQuadratic(massless, both, [](Complex s) { return std::abs(s) < 1e6; });
  EXPECT_EQ(std::ssize(pairs), m - 1);
  for (const auto& pair : pairs) EXPECT_EQ(pair.s.real(), 0);
  squares[0] = -4e8;  // diverges: s = ±2e4
  const DenseProblem buckled{unit, {}, reflected(squares, generator)};
  pairs = solveQuadratic(buckled, both);
  ASSERT_EQ(std::ssize(pairs), m + 1);
  EXPECT_NEAR(pairs[0].s.real() / -2e4, 1, 1e-12);
  EXPECT_NEAR(pairs[1].s.real() / 2e4, 1, 1e-12);
  EXPECT_LT(test::worstResidual(buckled, pairs), 1e-13);
}

// Damping of the size of rounding, as at the first friction of a sweep, leaves the undamped
// spectrum, double frequencies included.
TEST(Quadratic, DampingThatIsNextToNothing) {
  constexpr PetscInt m = 60;
  std::mt19937 generator(8);
  std::vector<double> squares;
  std::vector<Complex> exact;
  for (PetscInt i = 0; i < m; ++i) {
    exact.emplace_back(0, 1e4 * (1 + i / 2));
    squares.push_back(std::norm(exact.back()));
  }
  const DenseMatrix mass = reflected(std::vector<double>(m, 1.0), generator),
                    stiffness = reflected(squares, generator);
  DenseMatrix damping = test::randomMatrix(m, m, generator);
  for (double& entry : damping.entries()) entry *= 1e-12;
  expectSpectrum(eigenvaluesOf(solveQuadratic({mass, damping, stiffness})), exact, 1e-12);
}

// Without friction and damping the eigenvalues of a moving disc are imaginary, exactly: whatever
// rounding makes of a frequency of 1e-5 of the highest, some 1e-16 × 1e10 of itself, is not growth.
TEST(Quadratic, GyroscopicForcesLeaveNoGrowth) {
  constexpr PetscInt m = 40;
  std::mt19937 generator(5);
  std::vector<double> squares;
  for (PetscInt i = 0; i < m; ++i) squares.push_back(std::pow(10.0, 0.25 * i));  // 1 to 5.6e9
  DenseProblem problem{reflected(std::vector<double>(m, 1.0), generator), DenseMatrix(m, m),
                       reflected(squares, generator)};
  auto& damping = problem.damping;
  for (PetscInt j = 0; j < m; ++j)
    for (PetscInt i = 0; i < j; ++i) {
      damping(i, j) = 0.1 * test::uniform(generator);
      damping(j, i) = -damping(i, j);
    }
  const auto pairs = solveQuadratic(problem);
  ASSERT_EQ(std::ssize(pairs), m);
  for (const auto& pair : pairs) EXPECT_EQ(pair.s.real(), 0) << pair.s;
  // A little damping is not mistaken for none.
  for (PetscInt i = 0; i < m; ++i) damping(i, i) = 1e-9;
  for (const auto& pair : solveQuadratic(problem)) EXPECT_NE(pair.s.real(), 0) << pair.s;
}

/// Returns the volume that unit vectors span: 1 if they are orthogonal, 0 if they are dependent.
double volume(std::vector<std::vector<Complex>> vectors) {
  double product = 1;
  for (std::size_t j = 0; j < vectors.size(); ++j) {
    for (std::size_t k = 0; k < j; ++k) {
      Complex dot = 0;
      for (std::size_t i = 0; i < vectors[j].size(); ++i)
        dot += std::conj(vectors[k][i]) * vectors[j][i];
      for (std::size_t i = 0; i < vectors[j].size(); ++i) vectors[j][i] -= dot * vectors[k][i];
    }
    double square = 0;
    for (const auto& entry : vectors[j]) square += std::norm(entry);
    for (auto& entry : vectors[j]) entry /= std::sqrt(square);
    product *= std::sqrt(square);
  }
  return product;
}

// Z = α M + β K: s² + (α + β ω²) s + ω² = 0 for every mode of M and K, here with a triple one, the
// lowest and the highest overdamped.
TEST(Quadratic, ProportionalDampingOfMultipleModes) {
  constexpr PetscInt m = 90;
  constexpr double alpha = 25e3, beta = 5e-6;
  std::vector<double> squares, c;
  std::vector<Complex> exact;
  const auto frequency = [](PetscInt level) { return 1e4 * std::pow(60.0, level / (m - 1.0)); };
  for (PetscInt i = 0; i < m; ++i) {
    const double w = frequency(i == 31 || i == 32 ? 30 : i);
    squares.push_back(w * w);
    c.push_back(alpha + beta * w * w);
    const Complex root = std::sqrt(Complex(c.back() * c.back() / 4 - w * w));
    exact.push_back(-c.back() / 2 + root);
    if (root.imag() == 0) exact.push_back(-c.back() / 2 - root);
  }
  EXPECT_GT(exact.size(), m + 5u);   // at both ends some are overdamped
  EXPECT_LT(exact.size(), m + 50u);  // and in the middle some are not
  std::mt19937 generator;
  const DenseProblem problem{reflected(std::vector<double>(m, 1.0), generator),
                             reflected(c, generator), reflected(squares, generator)};
  const auto pairs = solveQuadratic(problem);
  // Entries are rounded at 1e-16 ‖K‖, 4e-13 of the lowest ω²; near critical damping the roots move
  // some ten times as much.
  expectSpectrum(eigenvaluesOf(pairs), exact, 1e-10);
  EXPECT_LT(test::worstResidual(problem, pairs), 1e-14);
  const double w = frequency(30), half = (alpha + beta * w * w) / 2;
  std::vector<std::vector<Complex>> triple;
  for (const auto& pair : pairs)
    if (std::abs(pair.s - Complex(-half, std::sqrt(w * w - half * half))) < 1e-8 * w)
      triple.push_back(pair.q);
  EXPECT_EQ(triple.size(), 3u);
  EXPECT_GT(volume(triple), 1e-3);  // three different modes, not one thrice
}

/// Checks real eigenvalues, ascending; an error relative to zero would be no number.
void expectReal(const DenseProblem& problem, const std::vector<double>& wanted) {
  auto found = eigenvaluesOf(solveQuadratic(problem));
  std::ranges::sort(found, {}, [](Complex s) { return s.real(); });
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_LT(std::abs(found[i] - wanted[i]), 1e-14);
}

// A matrix of zeros has no size to scale by. With M = 1 and Z = 3 the roots of s² + 3 s are 0 and
// −3; with M = 0, s + 2 has only one root.
TEST(Quadratic, WithoutStiffnessOrWithoutMass) {
  const auto one = [](double entry) { return test::square({entry}); };
  expectReal({one(1), one(3), one(0)}, {-3, 0});
  expectReal({one(0), one(1), one(2)}, {-2});
  expectReal({identity(2), test::square({1, 0, 0, 2}), DenseMatrix(2, 2)}, {-2, -1, 0, 0});
}

TEST(Quadratic, OfNoUnknowns) { EXPECT_TRUE(solveQuadratic({}).empty()); }

// Pairs that were found in bases of different sizes: the shorter vectors end with zeros.
TEST(Quadratic, SharedVectorsOfDifferentLengths) {
  using Vector = std::vector<Complex>;
  int rank = 0;
  check(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  std::vector<linalg::DensePair> pairs;
  for (const std::size_t length : {1, 400, 2})
    if (rank == 0) pairs.push_back({double(length), Vector(length, 2.0), Vector(length, 3.0)});
  linalg::shareFrom(0, PETSC_COMM_WORLD, pairs, linalg::Vectors::both);
  ASSERT_EQ(pairs.size(), 3u);
  for (const auto& pair : pairs) {
    Vector right(400), left(400);
    std::fill_n(right.begin(), std::size_t(pair.s.real()), 2.0);
    std::fill_n(left.begin(), std::size_t(pair.s.real()), 3.0);
    EXPECT_EQ(pair.q, right);
    EXPECT_EQ(pair.left, left);
  }
}

// LAPACK returns eigenvalues of such matrices without a word.
TEST(Quadratic, EntriesThatAreNotNumbersAreRefused) {
  for (const double entry : {NAN, INFINITY})
    for (const auto matrix :
         {&DenseProblem::mass, &DenseProblem::damping, &DenseProblem::stiffness}) {
      DenseProblem problem{identity(2), identity(2), identity(2)};
      (problem.*matrix)(0, 1) = entry;
      EXPECT_NE(test::errorOf([&] { solveQuadratic(problem); }), "");
    }
}

}  // namespace
}  // namespace squeal
