// SPDX-License-Identifier: BSD-2-Clause
// Bounds of norms and of couplings.
#include <gtest/gtest.h>

#include <random>

#include "algebra/linalg/symmetric.hpp"
#include "eigen/proof/expansion.hpp"
#include "eigen/proof/norm_bound.hpp"
#include "support/eigen/split_brake.hpp"

namespace {

using namespace squeal;
using linalg::ComplexMatrix;

/// Returns the 2-norm from the eigenvalues of [Re −Im; Im Re]ᵀ [Re −Im; Im Re].
double norm(const ComplexMatrix& a) {
  const PetscInt m = a.rows(), n = a.columns();
  linalg::DenseMatrix real(2 * m, 2 * n);
  for (PetscInt j = 0; j < n; ++j)
    for (PetscInt i = 0; i < m; ++i) {
      real(i, j) = real(m + i, n + j) = a(i, j).real();
      real(m + i, j) = a(i, j).imag();
      real(i, n + j) = -a(i, j).imag();
    }
  return std::sqrt(linalg::symmetricEigenvalues(linalg::transposedProduct(real, real)).back());
}

ComplexMatrix randomComplex(PetscInt m, PetscInt n, std::mt19937& generator) {
  ComplexMatrix a(m, n);
  for (auto& entry : a.entries()) entry = {test::uniform(generator), test::uniform(generator)};
  return a;
}

TEST(Bounds, NormsAreBoundedFromAbove) {
  std::mt19937 generator(1);
  for (const auto& [m, n] :
       {std::pair(30, 50), std::pair(50, 30), std::pair(1, 7), std::pair(7, 1), std::pair(40, 40)})
    for (int i = 0; i < 20; ++i) {
      auto a = randomComplex(m, n, generator);
      // Singular values that decay slowly or fast, so that power iteration settles or does not.
      for (PetscInt j = 0; j < n; ++j)
        for (PetscInt k = 0; k < m; ++k) a(k, j) *= std::pow(1 - 0.04 * i, j);
      const double exact = norm(a), bound = proof::normBound(a);
      EXPECT_GE(bound, exact * (1 - 1e-12));
      EXPECT_LE(bound, 1.021 * exact);
      EXPECT_GE(proof::quickBound(a), exact * (1 - 1e-12));
    }
  EXPECT_EQ(proof::normBound(ComplexMatrix(3, 4)), 0);
  EXPECT_EQ(proof::normBound(ComplexMatrix()), 0);
}

// A vector orthogonal to the dominant one as the start of the power iteration must not matter.
TEST(Bounds, PowerIterationDecidesNothing) {
  ComplexMatrix a(20, 20);
  for (PetscInt i = 0; i < 20; ++i) a(i, i) = 1;
  a(0, 0) = 1.3;
  for (PetscInt i = 1; i < 20; ++i) a(i, 0) = 1e-9;
  EXPECT_GE(proof::normBound(a), 1.3);
  EXPECT_LE(proof::normBound(a), 1.3 * 1.021);
}

/// Returns the bound at some points, for all couplings given by matrices or by their Grams.
std::vector<double> boundsOf(const test::SplitBrake& split, double top) {
  const proof::DiagonalForm form(split.problem, top);
  std::vector<double> bounds;
  for (const Complex z : {Complex(1, 0.1), Complex(-0.3, 0.8), Complex(0, 1.05)})
    bounds.push_back(proof::Expansion(form, z, 0).boundAtCentre());
  return bounds;
}

// The Gram matrices of all powers together determine the norm of the sum.
TEST(Bounds, GramsGiveTheSameBounds) {
  std::mt19937 generator(2);
  for (const auto damping : {test::Damping::none, test::Damping::all}) {
    const auto brake = test::randomBrake(60, damping, generator);
    const double top = 0.6 * brake.omega[12];
    const auto direct = boundsOf(test::split(brake, test::firstModes(12), true, false, top), top);
    const auto split = test::split(brake, test::firstModes(12), true, true, top);
    const auto byGrams = boundsOf(split, top);
    for (std::size_t i = 0; i < direct.size(); ++i)
      EXPECT_NEAR(byGrams[i], direct[i], 1e-3 * direct[i]);
    // In z = s² only without odd powers.
    EXPECT_EQ(proof::DiagonalForm(split.problem, top).squared(), damping == test::Damping::none);
  }
}

// The bound on a disc is above the norms at its points, computed from P_CV P_VV⁻¹ P_VC itself, and
// at the centre equal to it.
TEST(Bounds, DiscsBoundTheCoupling) {
  std::mt19937 generator(8);
  for (const auto damping : {test::Damping::none, test::Damping::all}) {
    const auto brake = test::randomBrake(60, damping, generator);
    const double top = 0.6 * brake.omega[12];
    const auto split = test::split(brake, test::firstModes(12), true, false, top);
    const proof::DiagonalForm form(split.problem, top);
    for (const Complex centre : {Complex(0.2, 0.9), Complex(-0.7, 0.7)})
      for (const int order : {0, 1, 2}) {
        const proof::Expansion expansion(form, centre, order);
        const double atCentre = norm(test::coupling(split.problem, form.outOfPlane(centre)));
        EXPECT_GE(expansion.boundAtCentre(), atCentre);
        EXPECT_LE(expansion.boundAtCentre(), 1.021 * atCentre);
        for (const double radius : {0.01, 0.03, 0.1}) {
          const double bound = expansion.bound(radius, {});
          for (int i = 0; i < 12; ++i) {
            const Complex z = centre + std::polar(radius, 0.5236 * i);
            EXPECT_GE(bound, norm(test::coupling(split.problem, form.outOfPlane(z))));
          }
        }
      }
  }
}

/// Returns a random matrix of this 2-norm.
linalg::DenseMatrix ofNorm(double size, PetscInt m, PetscInt n, std::mt19937& generator) {
  auto a = test::randomMatrix(m, n, generator);
  const double largest =
      std::sqrt(linalg::symmetricEigenvalues(linalg::transposedProduct(a, a)).back());
  for (auto& entry : a.entries()) entry *= size / largest;
  return a;
}

// The true couplings are W F + W' F' + remainder, with contractions W and remainders that the bound
// does not know: each draw stays below it.
TEST(Bounds, HoldForAllCouplingsWithTheMajorants) {
  std::mt19937 generator(9);
  const auto brake = test::randomBrake(60, test::Damping::none, generator);
  const double top = 0.6 * brake.omega[12];
  const auto split = test::split(brake, test::firstModes(12), true, false, top);
  auto known = split.problem;
  const auto& exact = split.problem.toLeftOut[0].coefficients[2];
  const double size = std::sqrt(
                   linalg::symmetricEigenvalues(linalg::transposedProduct(exact, exact)).back()),
               remainder = 0.05 * size;
  known.toLeftOut.push_back(known.toLeftOut[0]);
  const Complex z(0.1, 0.95);
  const proof::DiagonalForm exactForm(known, top);
  const double withoutRemainder = proof::Expansion(exactForm, z, 0).boundAtCentre();
  known.toLeftOut[0].error[2] = remainder;
  const proof::DiagonalForm form(known, top);
  const double withRemainder = proof::Expansion(form, z, 0).boundAtCentre();
  double largest = 0;
  for (int i = 0; i < 30; ++i) {
    auto truth = split.problem;
    auto& coupling = truth.toLeftOut[0].coefficients[2];
    const PetscInt rows = exact.rows();
    // The identity in one draw: W F + W F has twice the norm of F, [F; F] only √2 times.
    const auto contraction = [&] {
      return i == 0 ? test::identity(rows) : ofNorm(1, rows, rows, generator);
    };
    coupling = linalg::product(contraction(), exact);
    linalg::addScaled(coupling, 1, linalg::product(contraction(), exact));
    if (i % 2 == 1)
      linalg::addScaled(coupling, 1, ofNorm(remainder, rows, exact.columns(), generator));
    const double actual = norm(test::coupling(truth, form.outOfPlane(z)));
    EXPECT_LE(actual, i % 2 == 1 ? withRemainder : withoutRemainder);
    largest = std::max(largest, actual);
  }
  const proof::DiagonalForm single(split.problem, top);
  EXPECT_GT(largest, 1.9 * proof::Expansion(single, z, 0).boundAtCentre());
}

}  // namespace
