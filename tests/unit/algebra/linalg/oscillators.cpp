// SPDX-License-Identifier: BSD-2-Clause
// Small quadratic problems with answers in closed form: two coupled oscillators, damping, rotation,
// divergence, a motion without mass.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "algebra/linalg/quadratic.hpp"
#include "support/algebra/dense.hpp"
#include "support/algebra/oscillators.hpp"
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
using test::square;

const DenseMatrix none;

// Each problem is solved at its own size, and with a damping of zeros by its companion form.
TEST(Quadratic, ModesCoupleAtTheCriticalFriction) {
  const test::Oscillators pair{1.0, 1.5, 0.8};
  const double critical = pair.critical();
  EXPECT_NEAR(critical, 0.3125, 1e-15);
  for (const double f : {0.0, 0.1, 0.3, 0.9999 * critical, 1.0001 * critical, 0.4, 1.0, 3.0})
    for (const auto& damping : {none, DenseMatrix(2, 2)}) {
      const DenseProblem problem{test::identity(2), damping, pair.stiffness(f)};
      const auto found = solveQuadratic(problem);
      // Near the critical point the eigenvalue is a square root of the distance: rounding of 1e-16
      // grows by 1e2 at 1e-4 from it.
      expectSpectrum(eigenvaluesOf(found), pair.exact(f), 1e-13);
      EXPECT_LT(test::worstResidual(problem, found), 1e-14);
    }
  // At the critical point itself two eigenvalues and their vectors are one: half of the digits
  // remain.
  expectSpectrum(eigenvaluesOf(solveQuadratic({test::identity(2), none, pair.stiffness(critical)})),
                 pair.exact(critical), 1e-7);
}

// The problem is m s² + c s + k = 0: under-damped, over-damped (both roots are real and count),
// with negative damping.
TEST(Quadratic, DampedOscillator) {
  const double m = 2, k = 50;
  const auto eigenvalues = [&](double c) {
    return eigenvaluesOf(solveQuadratic({square({m}), square({c}), square({k})}));
  };
  for (const double c : {0.4, -0.4, 15.0}) {
    const Complex root = std::sqrt(Complex(c * c - 4 * m * k)) / (2 * m);
    expectSpectrum(eigenvalues(c), {-c / (2 * m) + root}, 1e-14);
  }
  const double c = 30, root = std::sqrt(c * c - 4 * m * k);
  expectSpectrum(eigenvalues(c), {(-c - root) / (2 * m), (-c + root) / (2 * m)}, 1e-14);
}

// Negative stiffness: s = ±√(−k/m), divergence without oscillation. Both count, the stable one
// first.
TEST(Quadratic, Divergence) {
  for (const auto& damping : {none, DenseMatrix(1, 1)}) {
    const auto pairs = solveQuadratic({square({2}), damping, square({-18})});
    ASSERT_EQ(pairs.size(), 2u);
    EXPECT_NEAR(pairs[0].s.real(), -3, 1e-14);
    EXPECT_NEAR(pairs[1].s.real(), 3, 1e-14);
    for (const auto& pair : pairs) EXPECT_EQ(pair.s.imag(), 0);
  }
}

// Gyroscopic forces: M = I, Z = [0, −g; g, 0], K = k I whirl forwards and backwards at ω = √(k +
// g²/4) ± g/2.
TEST(Quadratic, Whirl) {
  const double g = 0.7, k = 4;
  const double middle = std::sqrt(k + g * g / 4);
  const DenseProblem problem{test::identity(2), square({0, g, -g, 0}), square({k, 0, 0, k})};
  const auto pairs = solveQuadratic(problem);
  expectSpectrum(eigenvaluesOf(pairs), {{0, middle - g / 2}, {0, middle + g / 2}}, 1e-14);
  EXPECT_LT(test::worstResidual(problem, pairs), 1e-14);
}

// Without damping the problem is linear in s²; the companion form of twice the size must say the
// same. Stiffness in Pa·m.
TEST(Quadratic, CompanionAgreesWithLinearInSquare) {
  std::mt19937 generator(3);
  constexpr PetscInt m = 12;
  for (const double unit : {1.0, 1e9}) {
    DenseProblem linear{test::randomMatrix(m, m, generator, 8), none,
                        test::randomMatrix(m, m, generator, 4)};
    for (double& entry : linear.stiffness.entries()) entry *= unit;
    DenseProblem damped = linear;
    damped.damping = DenseMatrix(m, m);
    const auto direct = solveQuadratic(linear), companion = solveQuadratic(damped);
    expectSpectrum(eigenvaluesOf(companion), eigenvaluesOf(direct), 1e-12);
    for (std::size_t i = 1; i < direct.size(); ++i)
      EXPECT_LE(direct[i - 1].s.imag(), direct[i].s.imag());
    EXPECT_LT(test::worstResidual(linear, direct), 1e-13);
    EXPECT_LT(test::worstResidual(linear, companion), 1e-13);
  }
}

// A motion without mass has no eigenvalue; the others are found by the inverse of the stiffness.
// Nothing can be said where both are singular.
TEST(Quadratic, SingularMassLeavesTheFiniteEigenvalues) {
  const DenseMatrix mass = square({1, 0, 0, 0});
  for (const auto& damping : {none, DenseMatrix(2, 2)}) {
    const auto pairs = solveQuadratic({mass, damping, square({2, 0, 0, 3})});
    ASSERT_EQ(pairs.size(), 1u);
    EXPECT_NEAR(std::abs(pairs[0].s - Complex(0, std::sqrt(2.0))), 0, 1e-14);
  }
  EXPECT_NE(test::errorOf([&] { solveQuadratic({mass, none, square({2, 0, 0, 0})}); }), "");
}

}  // namespace
}  // namespace squeal
