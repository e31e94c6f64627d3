// SPDX-License-Identifier: BSD-2-Clause
// Derivatives of critical frictions of small oscillators, and second derivatives, in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "eigen/sensitivity/derive.hpp"
#include "support/algebra/sparse.hpp"
#include "support/harness/ranks.hpp"

namespace squeal::test {
namespace {

/// Returns this rank's rows of the unit vectors, distributed like the matrix.
linalg::Block unitVectors(Mat like) {
  PetscInt first = 0, end = 0, size = 0;
  check(MatGetSize(like, &size, nullptr));
  check(MatGetOwnershipRange(like, &first, &end));
  linalg::Block whole(end - first, size);
  for (PetscInt i = first; i < end; ++i) whole(i - first, i) = 1;
  return whole;
}

/// Returns the derivative of the critical friction by the speed; NaN without derivatives.
double bySpeed(std::vector<pencil::Term> terms, const sensitivity::CriticalPoint& point,
               pencil::CriticalMode& mode) {
  const factor::AssociatedSystem system(terms[0].matrix.share(), terms[1].matrix.share(), "K0");
  const linalg::Block whole = unitVectors(system.k0());
  const pencil::Pencil pencil(std::move(terms));
  sensitivity::deriveCritical(point, pencil, {whole, system.m0(), {}}, system,
                              sensitivity::parameterForms(pencil, point.at), mode);
  for (const auto& [parameter, value] : mode.derivatives)
    if (parameter == "speed") return value;
  return NAN;
}

// K = diag(k1, k2 + a v) + f k3 [0 1; −1 0], M = 1: the eigenvalues meet at
//   f* = (k2 + a v − k1) / (2 k3),   s² = −(k1 + k2 + a v) / 2,   df*/dv = a / (2 k3).
// There is one vector, so that the round-off of s² enters the derivative unmagnified.
TEST(Critical, CoalescenceOfTwoOscillators) {
  const double k1 = 1, k2 = 1.3, k3 = 0.8, a = 0.2, v = 1.5;
  std::vector<pencil::Term> terms;
  terms.push_back({matrixOf(2, {{0, 0, k1}, {1, 1, k2}})});
  terms.push_back({.matrix = matrixOf(2, {{0, 0, 1.0}, {1, 1, 1.0}}), .power = 2});
  terms.push_back({.matrix = matrixOf(2, {{1, 1, a}}), .speedExponent = 1});
  terms.push_back({.matrix = matrixOf(2, {{0, 1, k3}, {1, 0, -k3}}), .frictionExponent = 1});
  sweep::Parameters at{(k2 + a * v - k1) / (2 * k3)};
  at.speed = v;
  pencil::CriticalMode mode;
  const double found =
      bySpeed(std::move(terms), {at, std::sqrt((k1 + k2 + a * v) / 2), false}, mode);
  print("coalescence: %.15f, backward errors %.0e and %.0e\n", found, mode.rightBackwardError,
        mode.leftBackwardError);
  EXPECT_NEAR(found, a / (2 * k3), 1e-13);
}

// s² + (c v − b f) s + k = 0: Re s = 0 at f* = c v / b, s = i √k, df*/dv = c / b.
TEST(Critical, HopfOfOneOscillator) {
  const double c = 0.3, b = 0.7, v = 1.2, k = 2;
  std::vector<pencil::Term> terms;
  terms.push_back({matrixOf(1, {{0, 0, k}})});
  terms.push_back({.matrix = matrixOf(1, {{0, 0, 1.0}}), .power = 2});
  terms.push_back({.matrix = matrixOf(1, {{0, 0, c}}), .power = 1, .speedExponent = 1});
  terms.push_back(
      {.matrix = matrixOf(1, {{0, 0, b}}), .power = 1, .frictionExponent = 1, .factor = -1});
  sweep::Parameters at{c * v / b};
  at.speed = v;
  pencil::CriticalMode mode;
  EXPECT_NEAR(bySpeed(std::move(terms), {at, std::sqrt(k), true}, mode), c / b, 1e-14);
}

// s² + k + a v − b f = 0: s = 0 at f* = (k + a v) / b, df*/dv = a / b.
TEST(Critical, DivergenceOfOneOscillator) {
  const double k = 2, a = 0.5, b = 3, v = 1.2;
  std::vector<pencil::Term> terms;
  terms.push_back({matrixOf(1, {{0, 0, k}})});
  terms.push_back({.matrix = matrixOf(1, {{0, 0, 1.0}}), .power = 2});
  terms.push_back({.matrix = matrixOf(1, {{0, 0, a}}), .speedExponent = 1});
  terms.push_back({.matrix = matrixOf(1, {{0, 0, b}}), .frictionExponent = 1, .factor = -1});
  sweep::Parameters at{(k + a * v) / b};
  at.speed = v;
  pencil::CriticalMode mode;
  EXPECT_NEAR(bySpeed(std::move(terms), {at, 0, false}, mode), a / b, 1e-14);
}

// Without friction in the pencil the growth does not depend on it.
TEST(Critical, NoDerivativeWithoutInfluenceOfFriction) {
  std::vector<pencil::Term> terms;
  terms.push_back({matrixOf(1, {{0, 0, 2.0}})});
  terms.push_back({.matrix = matrixOf(1, {{0, 0, 1.0}}), .power = 2});
  pencil::CriticalMode mode;
  EXPECT_TRUE(std::isnan(bySpeed(std::move(terms), {{0.3}, std::sqrt(2.0), true}, mode)));
  EXPECT_TRUE(mode.derivatives.empty());
}

// Beyond the critical friction of K = diag(k1, k2) + f k3 [0 1; −1 0], M = 1,
//   s² = −(k1 + k2)/2 ± r,   r² = ((k2 − k1)/2)² − f² k3²,   r' = −f k3²/r,   r'' = −(k3² + r'²)/r,
// so that 2 s s' = ± r' and 2 s s'' = ± r'' − 2 s'². The neighbour is the decaying eigenvalue. The
// two with Im s < 0, farther away by 2 |s| / |s1 − s2| = 70, are left out.
TEST(SecondDerivative, OfTwoOscillatorsThatHaveMerged) {
  const double k1 = 1, k2 = 1.5, k3 = 0.8, f = 1.01 * (k2 - k1) / (2 * k3);
  std::vector<pencil::Term> terms;
  terms.push_back({matrixOf(2, {{0, 0, k1}, {1, 1, k2}})});
  terms.push_back({.matrix = matrixOf(2, {{0, 0, 1.0}, {1, 1, 1.0}}), .power = 2});
  terms.push_back({.matrix = matrixOf(2, {{0, 1, k3}, {1, 0, -k3}}), .frictionExponent = 1});
  const factor::AssociatedSystem system(terms[0].matrix.share(), terms[1].matrix.share(), "K0");
  const pencil::Pencil pencil(std::move(terms));
  const Complex r(0, std::sqrt(f * f * k3 * k3 - (k2 - k1) * (k2 - k1) / 4)),
      s = std::sqrt(r - (k1 + k2) / 2);
  pencil::ComplexModes point;
  point.at.friction = f;
  ASSERT_GT(s.real(), 0);
  ASSERT_GT(s.imag(), 0);
  point.eigenvalues = {{.s = s}, {.s = -std::conj(s)}};
  // (k1 + s²) x1 + f k3 x2 = 0.
  const Complex x2 = -(k1 + s * s) / (f * k3);
  point.shapes.emplace_back();
  point.shapes[0].unknowns = {vectorOf(system.k0(), true, {1, x2.real()}),
                              vectorOf(system.k0(), true, {0, x2.imag()})};
  const linalg::DenseProblem projected{denseCopy(system.m0()), {}, [&] {
                                         linalg::DenseMatrix k = denseCopy(system.k0());
                                         k(0, 1) += f * k3, k(1, 0) -= f * k3;
                                         return k;
                                       }()};
  const linalg::Block whole = unitVectors(system.k0());
  sensitivity::deriveParameters(point, pencil, {whole, system.m0(), projected}, system);
  const auto& found = point.sensitivities.at(0).derivatives.at(0);
  ASSERT_EQ(found.parameter, "friction");
  const Complex slope = -f * k3 * k3 / r, first = slope / (2.0 * s),
                second = (-(k3 * k3 + slope * slope) / r - 2.0 * first * first) / (2.0 * s);
  print("s' = %.6f, exact %.6f; s'' = %.4f, exact %.4f; 10 %% at %.2e of friction\n",
        found.value.real(), first.real(), found.second.real(), second.real(),
        found.growthHoldsTo());
  EXPECT_NEAR(std::abs(found.value - first), 0, 1e-9 * std::abs(first));
  EXPECT_NEAR(std::abs(found.second - second), 0, 0.05 * std::abs(second));
  // Where a tenth of the change is of second order, f rises by 0.4 of its distance to f*.
  EXPECT_NEAR(found.growthHoldsTo(), 0.4 * (f - f / 1.01), 0.04 * (f - f / 1.01));
}

}  // namespace
}  // namespace squeal::test
