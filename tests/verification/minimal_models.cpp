// Two-degree-of-freedom models of the literature, as pencils of 2 × 2 matrices, with critical
// frictions in closed form.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "direct/direct.hpp"
#include "pencil/complex_modes.hpp"
#include "pencil/pencil.hpp"
#include "support/case.hpp"
#include "support/model.hpp"
#include "support/spectrum.hpp"

namespace squeal {
namespace {

using test::Complex;

using Matrix2 = std::array<double, 4>;  // row by row

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

/// M ẍ + C ẋ + (K0 + μ K1) x = 0.
struct Model {
  Matrix2 mass, damping, stiffness, friction;

  pencil::ComplexModes at(double mu) const {
    std::vector<pencil::Term> terms;
    terms.push_back({matrix(stiffness), 0, 0, 1});
    terms.push_back({matrix(friction), 0, 1, 1});
    terms.push_back({matrix(mass), 2, 0, 1});
    if (damping != Matrix2{}) terms.push_back({matrix(damping), 1, 0, 1});
    const pencil::Pencil pencil(std::move(terms));
    return direct::solveDirect(pencil, {mu, 1.0}, matrix({1, 0, 0, 1}));
  }
  std::vector<Complex> eigenvalues(double mu) const { return test::eigenvaluesOf(at(mu)); }
  double growth(double mu) const {
    double largest = -INFINITY;
    for (const Complex s : eigenvalues(mu)) largest = std::max(largest, s.real());
    return largest;
  }
};

// N. Hoffmann, M. Fischer, R. Allgaier, L. Gaul, A minimal model for studying properties of the
// mode-coupling type instability in friction induced oscillations, Mechanics Research
// Communications 29 (2002) 197–205. A mass m on a belt, held by springs k1, k2 at the angles α1, α2
// to the belt and by the contact spring k3 across it; Coulomb friction μ k3 y along the belt. In
// (x, y):
//   K = [k11, k12 − μ k3; k12, k22],  k11 = Σ k_i cos² α_i,  k12 = Σ k_i sin α_i cos α_i,  k22 = Σ
//   k_i sin² α_i + k3.
// With M = m I:  (k11 − λ)(k22 − λ) = k12 (k12 − μ k3), λ = −m s². The frequencies merge where the
// discriminant vanishes,
//   (k11 − k22)²/4 + k12 (k12 − μ k3) = 0:  μ_c = (k12 + (k11 − k22)²/(4 k12)) / k3.
struct Belt {
  double m = 0.02, k1 = 1.1e4, k2 = 2.0e4, k3 = 1.3e4, alpha1 = 2.6, alpha2 = 0.5;  // rad

  double k11() const {
    return k1 * std::pow(std::cos(alpha1), 2) + k2 * std::pow(std::cos(alpha2), 2);
  }
  double k12() const {
    return k1 * std::sin(alpha1) * std::cos(alpha1) + k2 * std::sin(alpha2) * std::cos(alpha2);
  }
  double k22() const {
    return k1 * std::pow(std::sin(alpha1), 2) + k2 * std::pow(std::sin(alpha2), 2) + k3;
  }
  double discriminant(double mu) const {
    return std::pow((k11() - k22()) / 2, 2) + k12() * (k12() - mu * k3);
  }
  double critical() const { return (k12() + std::pow(k11() - k22(), 2) / (4 * k12())) / k3; }
  Model model() const { return {{m, 0, 0, m}, {}, {k11(), k12(), k12(), k22()}, {0, -k3, 0, 0}}; }
  std::vector<Complex> exact(double mu) const {
    std::vector<Complex> list;
    for (const double sign : {-1.0, 1.0}) {
      const Complex s =
          std::sqrt(-((k11() + k22()) / 2 + sign * std::sqrt(Complex(discriminant(mu)))) / m);
      list.push_back(s.imag() < 0 ? -s : s);
    }
    return list;
  }
};

TEST(MinimalModels, ModesOfTheBeltMergeAtTheCriticalFriction) {
  const Belt belt;
  const double critical = belt.critical(),
               middle = std::sqrt((belt.k11() + belt.k22()) / 2 / belt.m);
  test::setOptions("");
  EXPECT_GT(critical, 0.1);
  EXPECT_LT(critical, 1);
  EXPECT_NEAR(belt.discriminant(critical) / std::pow(belt.k11(), 2), 0, 1e-15);
  for (const double mu :
       {0.0, 0.5 * critical, (1 - 1e-4) * critical, (1 + 1e-4) * critical, 2 * critical}) {
    const auto point = belt.model().at(mu);
    // At 1e-4 from the merger, where the eigenvalue is a square root, rounding of 1e-16 grows by
    // 1e2.
    EXPECT_LT(test::worst(test::errors(belt.exact(mu), test::eigenvaluesOf(point)).relative), 1e-13)
        << mu;
    EXPECT_EQ(point.unstableCount(), mu > critical ? 1 : 0) << mu;
  }
  // At the merger both are one: half of the digits are left.
  for (const Complex s : belt.model().eigenvalues(critical))
    EXPECT_LT(std::abs(s - Complex(0, middle)), 1e-7 * middle);
}

// J.-J. Sinou, L. Jézéquel, Mode coupling instability in friction-induced vibrations and its
// dependency on system parameters including damping, European Journal of Mechanics A/Solids 26
// (2007) 106–122, in its normalised form: two modes with equal masses, coupled by a friction that
// is proportional to the displacement of the other,
//   ẍ1 + η1 ẋ1 + ω1² x1 − μ ω0² x2 = 0,  ẍ2 + η2 ẋ2 + ω2² x2 + μ ω0² x1 = 0.
// Characteristic polynomial s⁴ + a3 s³ + a2 s² + a1 s + a0:
//   a3 = η1 + η2, a2 = ω1² + ω2² + η1 η2, a1 = η1 ω2² + η2 ω1², a0 = ω1² ω2² + μ² ω0⁴.
// Routh and Hurwitz: flutter begins at a1 a2 a3 = a1² + a3² a0, where s² = −a1/a3:
//   μ_c² ω0⁴ = a1 a2 / a3 − (a1 / a3)² − ω1² ω2².
struct Coupled {
  double w1 = 600, w2 = 660, w0 = 500, eta1 = 0, eta2 = 0;

  double damped() const {
    const double a3 = eta1 + eta2, a2 = w1 * w1 + w2 * w2 + eta1 * eta2,
                 a1 = eta1 * w2 * w2 + eta2 * w1 * w1;
    return std::sqrt(a1 * a2 / a3 - std::pow(a1 / a3, 2) - std::pow(w1 * w2, 2)) / (w0 * w0);
  }
  double frequency() const { return std::sqrt((eta1 * w2 * w2 + eta2 * w1 * w1) / (eta1 + eta2)); }
  double undamped() const { return std::abs(w2 * w2 - w1 * w1) / (2 * w0 * w0); }
  Model model() const {
    return {{1, 0, 0, 1}, {eta1, 0, 0, eta2}, {w1 * w1, 0, 0, w2 * w2}, {0, -w0 * w0, w0 * w0, 0}};
  }
};

void expectChangeOfStability(const Coupled& coupled, double critical) {
  const auto model = coupled.model();
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
    for (const Complex s : coupled.model().eigenvalues(critical))
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
  EXPECT_LT(std::abs(coupled.model().growth(0)), 1e-10 * coupled.w1);
  // To first order in η2 and in μ² the growth is η2 (μ ω0²)² / (2 (ω2² − ω1²)²), 0.02 here.
  for (const double mu : {0.01, 0.05, 0.1}) EXPECT_GT(coupled.model().growth(mu), 0.01);
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
    for (const Complex s0 : undamped.model().eigenvalues(mu)) {
      const double half = coupled.eta1 / 2;
      const Complex root = std::sqrt(half * half + s0 * s0);  // −λ = s0²
      wanted.push_back(-half + (root.imag() < 0 ? -root : root));
    }
    EXPECT_LT(test::worst(test::errors(wanted, coupled.model().eigenvalues(mu)).relative), 1e-13);
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
    const auto model = coupled.model();
    // The growth is at most the damping, 1e-3 of 600; its sign is what counts.
    if (ratio != 1) {
      EXPECT_LT(model.growth(0.99 * limit), 0);
      EXPECT_GT(model.growth(1.01 * limit), 0);
    }
  }
}

}  // namespace
}  // namespace squeal
