// SPDX-License-Identifier: BSD-2-Clause
// Two-degree-of-freedom models of the literature, as pencils of 2 × 2 matrices, with critical
// frictions in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "eigen/direct/direct.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/pencil.hpp"
#include "exact/minimal_models.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/harness/largest_error.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using exact::minimal_models::Belt;
using exact::minimal_models::Coupled;
using exact::minimal_models::Matrix2;
using test::Complex;

OwnedMat matrix(const Matrix2& entries) {
  OwnedMat result;
  check(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, 2, 2, 2, nullptr, 2, nullptr,
                     result.out()));
  PetscInt first = 0, end = 0;
  check(MatGetOwnershipRange(result, &first, &end));
  for (PetscInt i = first; i < end; ++i)
    for (PetscInt j = 0; j < 2; ++j)
      check(MatSetValue(result, i, j, entries[2 * i + j], INSERT_VALUES));
  check(MatAssemblyBegin(result, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(result, MAT_FINAL_ASSEMBLY));
  return result;
}

/// A model as the program solves it.
struct Model : exact::minimal_models::Matrices {
  pencil::ComplexModes at(double mu) const {
    std::vector<pencil::Term> terms;
    terms.push_back({matrix(stiffness), 0, 0, 1});
    terms.push_back({matrix(friction), 0, 1, 1});
    terms.push_back({matrix(mass), 2, 0, 1});
    if (damping != Matrix2{}) terms.push_back({matrix(damping), 1, 0, 1});
    const pencil::Pencil pencil(std::move(terms));
    return direct::solveDirect(pencil, {mu, 1.0}, matrix({1, 0, 0, 1}),
                               direct::Settings::given(pencil::Settings::given()));
  }
  std::vector<Complex> eigenvalues(double mu) const { return test::eigenvaluesOf(at(mu)); }
  double growth(double mu) const {
    double largest = -INFINITY;
    for (const Complex s : eigenvalues(mu)) largest = test::worse(largest, s.real());
    return largest;
  }
};

TEST(MinimalModels, ModesOfTheBeltMergeAtTheCriticalFriction) {
  const Belt belt;
  const double critical = belt.critical(),
               middle = std::sqrt((belt.k11() + belt.k22()) / 2 / belt.m);
  const Model model{belt.matrices()};
  test::setOptions("");
  EXPECT_GT(critical, 0.1);
  EXPECT_LT(critical, 1);
  EXPECT_NEAR(belt.discriminant(critical) / std::pow(belt.k11(), 2), 0, 1e-15);
  for (const double mu :
       {0.0, 0.5 * critical, (1 - 1e-4) * critical, (1 + 1e-4) * critical, 2 * critical}) {
    const auto point = model.at(mu);
    // At 1e-4 from the merger, where the eigenvalue is a square root, rounding of 1e-16 grows by
    // 1e2.
    EXPECT_LT(test::worst(test::errors(belt.exact(mu), test::eigenvaluesOf(point)).relative), 1e-13)
        << mu;
    EXPECT_EQ(point.unstableCount(), mu > critical ? 1 : 0) << mu;
  }
  // At the merger both are one: half of the digits are left.
  const auto merged = model.eigenvalues(critical);
  EXPECT_EQ(merged.size(), 2u);
  for (const Complex s : merged) EXPECT_LT(std::abs(s - Complex(0, middle)), 1e-7 * middle);
}

void expectChangeOfStability(const Coupled& coupled, double critical) {
  const Model model{coupled.matrices()};
  EXPECT_LT(std::abs(model.growth(critical)), 1e-10 * coupled.w1);
  EXPECT_LT(model.growth((1 - 1e-6) * critical), 0);
  EXPECT_GT(model.growth((1 + 1e-6) * critical), 0);
}

// Unequal damping of the modes lowers the critical friction: the destabilisation paradox.
TEST(MinimalModels, UnequalDampingDestabilises) {
  test::setOptions("-flutter_unstable_tolerance 0");
  for (const auto& [eta1, eta2] : {std::pair{1.0, 30.0}, {2.0, 30.0}, {30.0, 6.0}, {30.0, 12.0}}) {
    Coupled coupled;
    coupled.eta1 = eta1, coupled.eta2 = eta2;
    const double critical = coupled.damped();
    expectChangeOfStability(coupled, critical);
    EXPECT_LT(critical, coupled.undamped());
    // The mode that begins to flutter has s² = −a1 / a3.
    double nearest = INFINITY;
    for (const Complex s : Model{coupled.matrices()}.eigenvalues(critical))
      nearest = std::min(nearest, std::abs(s - Complex(0, coupled.frequency())));
    EXPECT_LT(nearest, 1e-10 * coupled.w1);
    test::print("damping %g and %g: critical friction %.4f, undamped %.4f\n", eta1, eta2, critical,
                coupled.undamped());
  }
}

// In the extreme, one mode without any damping, every friction is too much.
TEST(MinimalModels, DampingOfOneModeAloneLeavesNoStableFriction) {
  test::setOptions("");
  Coupled coupled;
  coupled.eta2 = 30;
  EXPECT_NEAR(coupled.damped(), 0, 1e-7);
  EXPECT_LT(std::abs(Model{coupled.matrices()}.growth(0)), 1e-10 * coupled.w1);
  // To first order in η2 and in μ² the growth is η2 (μ ω0²)² / (2 (ω2² − ω1²)²), 0.02 here.
  for (const double mu : {0.01, 0.05, 0.1}) EXPECT_GT(Model{coupled.matrices()}.growth(mu), 0.01);
}

// Equal damping η of both modes: s² + η s = −λ has the undamped λ, so that s = −η/2 + √(η²/4 − λ):
// all eigenvalues are shifted, and the critical friction rises.
TEST(MinimalModels, EqualDampingStabilises) {
  test::setOptions("");
  Coupled coupled, undamped;
  coupled.eta1 = coupled.eta2 = 30;
  EXPECT_GT(coupled.damped(), undamped.undamped());
  expectChangeOfStability(coupled, coupled.damped());
  for (const double mu : {0.0, 0.1, 0.3, 0.6}) {
    std::vector<Complex> wanted;
    for (const Complex s0 : Model{undamped.matrices()}.eigenvalues(mu)) {
      const double half = coupled.eta1 / 2;
      const Complex root = std::sqrt(half * half + s0 * s0);  // −λ = s0²
      wanted.push_back(-half + (root.imag() < 0 ? -root : root));
    }
    EXPECT_LT(test::worst(test::errors(wanted, Model{coupled.matrices()}.eigenvalues(mu)).relative),
              1e-13);
  }
}

// The limit of vanishing unequal damping is not the critical friction without damping (Ziegler
// 1952; for these modes, with η1/η2 → r: μ_c² ω0⁴ → r/(1 + r)² (ω2² − ω1²)², below the undamped
// (ω2² − ω1²)²/4 unless r = 1).
TEST(MinimalModels, VanishingDampingKeepsItsEffect) {
  test::setOptions("");
  Coupled coupled;
  coupled.eta2 = 1e-3;
  for (const double ratio : {0.1, 0.5, 1.0, 4.0}) {
    coupled.eta1 = ratio * coupled.eta2;
    const double limit = std::sqrt(ratio) / (1 + ratio) * 2 * coupled.undamped();
    EXPECT_NEAR(coupled.damped(), limit, 1e-9);
    const Model model{coupled.matrices()};
    // The growth is at most the damping, 1e-3 of 600; its sign is what counts.
    if (ratio != 1) {
      EXPECT_LT(model.growth(0.99 * limit), 0);
      EXPECT_GT(model.growth(1.01 * limit), 0);
    }
  }
}

}  // namespace
}  // namespace squeal
