// SPDX-License-Identifier: BSD-2-Clause
// Derivatives of critical frictions of small oscillators in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "eigen/sensitivity/derive.hpp"
#include "support/algebra/sparse.hpp"
#include "support/harness/ranks.hpp"

namespace squeal::test {
namespace {

/// Returns the derivative of the critical friction by the speed; NaN without derivatives.
double bySpeed(std::vector<pencil::Term> terms, const sensitivity::CriticalPoint& point,
               pencil::CriticalMode& mode) {
  PetscInt size = 0;
  check(MatGetSize(terms[0].matrix, &size, nullptr));
  const factor::AssociatedSystem system(terms[0].matrix.share(), terms[1].matrix.share(), "K0");
  OwnedBV whole;
  OwnedVec like;
  check(MatCreateVecs(system.k0(), like.out(), nullptr));
  check(BVCreate(PETSC_COMM_WORLD, whole.out()));
  check(BVSetType(whole, BVSVEC));
  check(BVSetSizesFromVec(whole, like, size));
  for (PetscInt j = 0; j < size; ++j) {
    std::vector<double> unit(size, 0.0);
    unit[j] = 1;
    check(BVInsertVec(whole, j, vectorOf(system.k0(), true, unit)));
  }
  const pencil::Pencil pencil(std::move(terms));
  sensitivity::deriveCritical(point, pencil, {whole.share(), system.m0(), {}}, system,
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

}  // namespace
}  // namespace squeal::test
