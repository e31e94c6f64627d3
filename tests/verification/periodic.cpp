// SPDX-License-Identifier: BSD-2-Clause
// Periodic motions by shooting, stable or not: a mass on a belt, whose cycles and their stability
// are known exactly.
#include <gtest/gtest.h>

#include <cmath>

#include "regime/cycles/branch.hpp"
#include "regime/cycles/section.hpp"
#include "regime/cycles/shooting.hpp"
#include "support/regime/reduced_models.hpp"

namespace squeal {
namespace {

using cycles::Orbit;
using cycles::Period;
using cycles::ShootingResult;
using test::massOnBelt;

constexpr double flutter = 2 * M_PI / 1.422701;  // period of the unstable mode at friction 0.9
constexpr double tolerance = 1e-9;

/// Returns the mean of a march as an orbit to begin with.
Orbit guessOf(const march::ReducedModel& model, int steps) {
  const double h = flutter / 1024;
  march::Massless scheme(model, march::initialStateAt({{0.05, 0.02}, {0, 0}, {0, 0}, {0, 0}}, h),
                         h);
  cycles::Section section(model, {1, -1}, flutter);
  while (scheme.state().time < 60) scheme.step(), section.inspect(scheme);
  Orbit orbit = cycles::firstOrbits(section.take(), h, steps).at(0);
  orbit.friction = 0.9;
  return orbit;
}

ShootingResult shot(Period& period) {
  return cycles::shoot(period, guessOf(period.model(), period.steps()), {tolerance});
}

Complex product(const std::vector<Complex>& values) {
  Complex result = 1;
  for (const Complex value : values) result *= value;
  return result;
}

// The derivative of a period by its start against differences.
TEST(Periodic, DerivativeIsThatOfThePassage) {
  auto model = massOnBelt(0.1);
  model.boundaryStiffness(1, 1) = 1e4;
  Period period(PETSC_COMM_SELF, model, 0.9, 512);
  Orbit orbit = shot(period).orbit;
  // A start at which the mass sticks: its slip belongs to the state.
  for (int i = 0; i < 512 && period.derivative(orbit).stuck.empty(); i += 8)
    orbit.start = period.pass(orbit, 8).end;
  const auto derivative = period.derivative(orbit);
  ASSERT_EQ(derivative.stuck, std::vector<PetscInt>{1});
  for (PetscInt j = 0; j < 5; ++j) {
    constexpr double step = 1e-8;
    Orbit ahead = orbit, behind = orbit;
    const auto entry = [&](Orbit& from) -> double& {
      return j < 2 ? from.start.q[j] : j < 4 ? from.start.v[j - 2] : from.start.z[1];
    };
    entry(ahead) += step, entry(behind) -= step;
    const auto to = period.pass(ahead).end, from = period.pass(behind).end;
    // In the plane a motion is piecewise linear; the contact forces hold to 1e-10, and with them
    // differences to 1e-10/1e-8 at most.
    const auto compare = [](double exact, double difference) {
      EXPECT_NEAR(exact, difference, 1e-3 * (1 + std::abs(exact)));
    };
    for (int i = 0; i < 2; ++i) {
      compare(derivative.end(i, j), (to.q[i] - from.q[i]) / (2 * step));
      compare(derivative.end(2 + i, j), (to.v[i] - from.v[i]) / (2 * step));
    }
  }
}

// The period was integrated event by event to 1e-12. The mass slides all the time, and the massless
// end of the spring makes the forces continuous: volumes in the space of q and v shrink by
// exp(−∫ tr C dt) = exp(−0.1 T), which is the product of all multipliers (Liouville).
TEST(Periodic, MassOnABelt) {
  for (const int steps : {512, 2048}) {
    const double h = 4.5601505 / steps;
    Period period(PETSC_COMM_SELF, massOnBelt(1), 0.9, steps);
    const ShootingResult found = shot(period);
    ASSERT_TRUE(found.converged);
    EXPECT_LT(found.change, tolerance);
    EXPECT_NEAR(found.orbit.period, 4.5601505, h / 50);
    const auto multipliers = found.linearisation->multipliers();
    ASSERT_EQ(multipliers.values.size(), 4u);
    // The leapfrog rule with the mean of the damping keeps this to the order h².
    EXPECT_NEAR(product(multipliers.values).real(), std::exp(-0.1 * found.orbit.period), h * h);
    // A contact that opens within a step is open for the whole of it: the shift in time is exact
    // only up to the order h.
    EXPECT_NEAR(multipliers.values[multipliers.trivial].real(), 1, 5 * h);
    EXPECT_EQ(found.measures.opening, 1);
    EXPECT_EQ(found.measures.sticking, 0);
  }
}

// With the slow belt it sticks as well, against a spring of 1e4 in series, which changes the period
// by a ten-thousandth. Sticking makes the motion forget: the multipliers that are not 1 fall.
TEST(Periodic, MassOnASlowBelt) {
  auto model = massOnBelt(0.1);
  model.boundaryStiffness(1, 1) = 1e4;
  Period period(PETSC_COMM_SELF, model, 0.9, 2048);
  const ShootingResult found = shot(period);
  ASSERT_TRUE(found.converged);
  EXPECT_NEAR(found.orbit.period, 4.5952294, 2e-4);
  EXPECT_EQ(found.measures.sticking, 1);
  const auto multipliers = found.linearisation->multipliers();
  EXPECT_NEAR(multipliers.values[multipliers.trivial].real(), 1, 5 * 4.595 / 2048);
  EXPECT_LT(std::abs(product(multipliers.values)), 0.1);
}

// TrackedLine downwards the branch ends where motions become linear, which is where the mode is
// neutral: the belt's stiffness has the eigenvalues μ = 2 ± √(1 − 4 f/3), and s² + 0.05 s + μ = 0
// has an imaginary root for |Im μ| = 0.05 √(Re μ), at f = (1 + 0.05² · 2) · 3/4. The leapfrog rule
// keeps it, as it keeps the damping; the last motion that touches a limit lies a step aroute.
TEST(Periodic, BranchEndsAtTheOnsetOfFlutter) {
  Period period(PETSC_COMM_SELF, massOnBelt(1), 0.9, 1024);
  const ShootingResult found = shot(period);
  ASSERT_TRUE(found.converged);
  std::vector<Orbit> motions;
  const auto route = cycles::continueBranch(
      period, found, false, {0.1, 2, 40, tolerance}, {},
      [&](const ShootingResult& motion) { motions.push_back(motion.orbit); });
  EXPECT_EQ(route.reason, "no node separates or sticks");
  EXPECT_NEAR(route.end, 0.75375, 1e-4);
  EXPECT_TRUE(route.folds.empty());
  // At the friction of one of these motions a model made there has the same one: forces of steady
  // sliding at another friction are no more than a reference.
  ASSERT_GT(motions.size(), 2u);
  auto model = massOnBelt(1);
  model.nodes[0].friction = motions[1].friction;
  model.nodes[0].shear[0] = -motions[1].friction;
  Period there(PETSC_COMM_SELF, model, motions[1].friction, 1024);
  Orbit guess = guessOf(model, 1024);
  guess.friction = motions[1].friction;
  const ShootingResult same = cycles::shoot(there, guess, {tolerance});
  ASSERT_TRUE(same.converged);
  // Both begin where the phase condition puts them; the step makes a period depend on that.
  EXPECT_NEAR(same.orbit.period, motions[1].period, 1e-4);
}

}  // namespace
}  // namespace squeal
