// SPDX-License-Identifier: BSD-2-Clause
// A block on a belt under a coefficient of friction that falls with the speed: its growth from
// steady sliding, and the cycle of stick and slip that it ends in.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "regime/march/law.hpp"
#include "support/regime/reduced_models.hpp"

namespace squeal {
namespace {

using march::ReducedModel;

constexpr double belt = 0.3, damping = 0.02, kinetic = 0.4, ratio = 1.5, decay = 0.4;

double law(double speed) { return 1 + (ratio - 1) * std::exp(-speed / decay); }
double lawSlope(double speed) { return -(ratio - 1) / decay * std::exp(-speed / decay); }

/// ẍ + c ẋ + x = f φ(|v − ẋ|) sign(v − ẋ), about steady sliding, where the slip is −x + z: the
/// surface of the block gives by z under the stiffness and the damping.
ReducedModel blockOnBelt(double stiffness, double boundaryDamping) {
  ReducedModel model = test::emptyModel(1, 1);
  model.stiffness = {1};
  model.damping(0, 0) = damping;
  model.jump(1, 0) = -1;
  model.boundaryStiffness(0, 0) = 1, model.boundaryStiffness(1, 1) = stiffness;
  model.boundaryDamping(1, 1) = boundaryDamping;
  test::slide(model.nodes[0], kinetic * law(belt), 1, belt);
  model.nodes[0].lawCoefficient = kinetic;
  model.nodes[0].frictionSlope = kinetic * lawSlope(belt);
  model.law = law;
  return model;
}

// Without a flexible surface s² + (c + f φ′) s + 1 = 0.
TEST(FrictionLaw, LinearModelHasItsEigenvalue) {
  const ReducedModel model = blockOnBelt(1e9, 1);
  const double decayRate = (damping + kinetic * lawSlope(belt)) / 2;
  const Complex exact(-decayRate, std::sqrt(1 - decayRate * decayRate)),
      found = march::nearestMode(model, {0, 1}).s;
  EXPECT_NEAR(std::abs(found - exact), 0, 1e-8);
  EXPECT_GT(found.real(), 0.1);
}

/// The growth of a mode, from the modal energies of the first and the third period of a march.
double growthOf(march::Scheme& scheme, Complex s) {
  const double period = 2 * M_PI / s.imag();
  std::array<double, 2> largest{};
  while (scheme.state().time < 3 * period) {
    scheme.step();
    const int cycle = int(scheme.state().time / period);
    if (cycle == 0) largest[0] = std::max(largest[0], scheme.state().kinetic);
    if (cycle == 2) largest[1] = std::max(largest[1], scheme.state().kinetic);
  }
  return std::log(largest[1] / largest[0]) / (2 * 2 * period);
}

// The surface gives, and both schemes are tried. The start is small, so that the curvature of the
// law is nothing, but large against the accuracy of the forces.
TEST(FrictionLaw, GrowthIsOfFirstOrder) {
  const ReducedModel model = blockOnBelt(20, 2);
  const auto mode = march::nearestMode(model, {0.1, 1});
  const auto start = march::startOn(mode, 5e-4 / std::abs(mode.q[0]));
  for (const auto& scheme : {march::masslessScheme, march::moreauScheme}) {
    std::vector<double> errors;
    for (const double h : {2e-2, 1e-2})
      errors.push_back(growthOf(*scheme(model, start, h), mode.s) - mode.s.real());
    EXPECT_LT(std::abs(errors[1]), 2e-3 * mode.s.real());
    EXPECT_NEAR(errors[0] / errors[1], 2, 0.2);
  }
}

/// The largest |x| of the cycle, by the rule of Runge and Kutta of fourth order from the end of
/// stick, x + c v = f φ(0) and ẋ = v, to where the block rests on the belt again.
double cycleAmplitude() {
  using State = std::array<double, 2>;
  const auto rate = [](const State& y) {
    return State{y[1], kinetic * law(belt - y[1]) - damping * y[1] - y[0]};
  };
  const auto ahead = [](const State& y, double h, const State& k) {
    return State{y[0] + h * k[0], y[1] + h * k[1]};
  };
  constexpr double h = 1e-4;
  State y{kinetic * law(0) - damping * belt, belt};
  double largest = y[0];
  for (int step = 0; step == 0 || y[1] < belt; ++step) {
    const State k1 = rate(y), k2 = rate(ahead(y, h / 2, k1)), k3 = rate(ahead(y, h / 2, k2)),
                k4 = rate(ahead(y, h, k3));
    for (int i = 0; i < 2; ++i) y[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    largest = std::max(largest, std::abs(y[0]));
  }
  return largest;
}

TEST(FrictionLaw, BlockFindsItsCycle) {
  const ReducedModel model = blockOnBelt(1e9, 1);
  const double exact = cycleAmplitude(), steady = kinetic * law(belt);
  std::vector<double> errors;
  for (const double h : {4e-3, 2e-3}) {
    const auto scheme = march::moreauScheme(model, {{0.1}, {0}, {0, 0}, {0, 0}}, h);
    double largest = 0;
    while (scheme->state().time < 160) {
      scheme->step();
      if (scheme->state().time > 120)
        largest = std::max(largest, std::abs(steady + scheme->state().q[0]));
    }
    errors.push_back(largest - exact);
    EXPECT_NEAR(largest, exact, 2e-4);
  }
  EXPECT_NEAR(errors[0] / errors[1], 2, 0.3);
}

// One degree of freedom: −(h k + c)⁻¹ R_N f φ′, or with h/2 and a rising law.
TEST(FrictionLaw, GainIsThatOfOneSlip) {
  const ReducedModel model = blockOnBelt(20, 2);
  EXPECT_NEAR(march::lawGain(model, 0.1, {-1}), 1 / (0.1 * 20 + 2), 1e-14);
  EXPECT_NEAR(march::lawGain(model, 0.1, {1}), 1 / (0.05 * 20 + 2), 1e-14);
  EXPECT_NEAR(march::lawGain(model, 0, {-1}), 0.5, 1e-14);
  EXPECT_NEAR(march::steepestSlopes(model, true)[0], kinetic * lawSlope(0), 0.01);
  EXPECT_EQ(march::steepestSlopes(model, false)[0], 0);
}

// A node to which no law applies keeps its coefficient.
TEST(FrictionLaw, LeavesCoefficientsWithoutLaw) {
  ReducedModel model = blockOnBelt(20, 2);
  model.nodes[0].lawCoefficient = 0;
  const auto scheme = march::masslessScheme(model, {{0.1}, {0}, {0, 0}, {0, 0}}, 1e-2);
  for (int i = 0; i < 10; ++i) scheme->step();
  EXPECT_EQ(scheme->friction()[0], kinetic * law(belt));
}

}  // namespace
}  // namespace squeal
