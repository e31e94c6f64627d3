// SPDX-License-Identifier: BSD-2-Clause
// The motion after flutter of minimal models with exact solutions: a mass on a belt that lifts off,
// a block on a belt with a static and a kinetic coefficient, a bar that hits a wall, and the
// stick-slip wave of an elastic tube on a rotating shaft.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "algebra/linalg/symmetric.hpp"
#include "regime/march/model.hpp"
#include "regime/march/scheme.hpp"
#include "support/regime/reduced_models.hpp"

namespace squeal {
namespace {

using march::ReducedModel;
using march::Start;
using test::emptyModel;
using test::Marched;
using test::marched;
using test::massOnBelt;
using test::onWave;
using test::slide;
using test::Tube;
using test::TubeModel;
using test::tubeModel;
using test::tubeOf;
using test::Wave;
using test::waveOf;

struct Cycle {
  double period = 0, open = 0, stick = 0;
};

/// Marches the mass on a belt onto its cycle and returns its means over 20 cycles.
Cycle cycleOfBelt(double v, double h) {
  const ReducedModel model = massOnBelt(v);
  const Start start{{0.05, 0.02}, {0, 0}, {0, 0}, {0, 0}};
  const auto scheme = march::moreauScheme(model, start, h);
  while (scheme->state().time < 300) scheme->step();
  // From one passage of y* = (q₁ − q₂)/√2 through its mean −0.5, upwards, to the 20th after it.
  const auto level = [&] { return scheme->state().q[0] - scheme->state().q[1] + 0.5; };
  double first = 0, last = 0, before = level();
  int passages = -1;
  Cycle cycle;
  while (passages < 20) {
    scheme->step();
    const double now = level();
    if (passages >= 0) {
      cycle.open += scheme->state().force[0] == 0 ? h : 0;
      cycle.stick +=
          scheme->state().force[0] > 0 && std::abs(scheme->state().rate[1]) < 1e-5 * v ? h : 0;
    }
    if (before < 0 && now >= 0) {
      last = scheme->state().time - h * now / (now - before);
      if (++passages == 0) first = last;
    }
    before = now;
  }
  cycle.period = (last - first) / 20;
  cycle.open /= 20, cycle.stick /= 20;
  return cycle;
}

/// The error of a figure is of the order h, so that half the step halves it, and two steps take it
/// out up to the order h².
void checkFirstOrder(double coarse, double fine, double exact) {
  EXPECT_NEAR((coarse - exact) / (fine - exact), 2, 0.3);
  EXPECT_NEAR(2 * fine - coarse, exact, 2e-3);
}

// Periods and durations integrated event by event to 1e-12.
TEST(Regime, MassOnABeltLiftsOff) {
  const Cycle coarse = cycleOfBelt(1, 2e-3), fine = cycleOfBelt(1, 1e-3);
  checkFirstOrder(coarse.period, fine.period, 4.5601505);
  // A duration is a whole number of steps: three of them at its two ends.
  EXPECT_NEAR(coarse.open, 1.4355447, 3 * 2e-3);
  EXPECT_NEAR(fine.open, 1.4355447, 3 * 1e-3);
  EXPECT_EQ(coarse.stick + fine.stick, 0);
}

TEST(Regime, MassOnASlowBeltLiftsOffAndSticks) {
  const Cycle coarse = cycleOfBelt(0.1, 2e-3), fine = cycleOfBelt(0.1, 1e-3);
  checkFirstOrder(coarse.period, fine.period, 4.5952294);
  checkFirstOrder(coarse.stick, fine.stick, 0.6520916);
  EXPECT_NEAR(coarse.open, 1.4237193, 3 * 2e-3);
  EXPECT_NEAR(fine.open, 1.4237193, 3 * 1e-3);
}

// A block on a belt, ω = 1, with more friction at rest than in sliding: with A = (F_s − F_k)/k it
// sticks for 2A/v and slides for (2/ω)(π − atan(Aω/v)).
TEST(Regime, BlockOnABeltSticksAndSlips) {
  constexpr double a = 0.15, v = 0.1, kinetic = 0.3,
                   exact = 2 * a / v + 2 * (M_PI - 0.98279372324732906799);  // atan(1.5)
  for (const double h : {2e-3, 1e-3}) {
    ReducedModel model = emptyModel(1, 1);
    model.stiffness = {1};
    model.jump(1, 0) = -1;
    model.boundaryStiffness(0, 0) = 1, model.boundaryStiffness(1, 1) = 1e9;
    slide(model.nodes[0], kinetic, 1, v);
    model.law = [&](double speed) { return speed < 1e-7 * v ? (kinetic + a) / kinetic : 1; };
    // It rests on the belt at first.
    const auto scheme = march::moreauScheme(model, {{0}, {v}, {0, 0}, {0, 0}}, h);
    std::vector<double> passages;
    double before = 0;
    while (passages.size() < 8) {
      scheme->step();
      const double now = scheme->state().q[0];
      if (before < 0 && now >= 0)
        passages.push_back(scheme->state().time - h * now / (now - before));
      before = now;
    }
    // The coefficient follows a step later than the slip: an error of two steps a cycle.
    EXPECT_NEAR((passages[7] - passages[1]) / 6, exact, 3 * h);
  }
}

// A bar of length 1 and wave speed 1 hits a wall with its end, which has no mass: they part
// after 2. With lumped masses, and steps near the time in which a wave crosses a cell, waves keep
// their shape.
TEST(Regime, BarLeavesTheWallAfterAReflectedWave) {
  constexpr int cells = 100;
  constexpr double length = 1.0 / cells, spring = cells, velocity = 0.01;
  linalg::DenseMatrix k(cells, cells), m(cells, cells);
  for (int i = 0; i < cells; ++i) {
    // Node i at x = i/cells; the end at cells is held here.
    m(i, i) = i == 0 ? length / 2 : length;
    k(i, i) = i == 0 ? spring : 2 * spring;
    if (i > 0) k(i, i - 1) = k(i - 1, i) = -spring;
  }
  ReducedModel model = emptyModel(cells, 1);
  linalg::DenseMatrix masses = m;
  model.stiffness = linalg::symmetricEigen(k, masses);
  Start start;
  for (int j = 0; j < cells; ++j) {
    model.couplingStiffness(0, j) = -spring * k(cells - 1, j);
    double rate = 0;
    for (int i = 0; i < cells; ++i) rate -= velocity * m(i, i) * k(i, j);
    start.q.push_back(0), start.v.push_back(rate);
  }
  model.boundaryStiffness(0, 0) = spring, model.boundaryStiffness(1, 1) = 1;
  model.moves[1] = 0;
  start.z = {0, 0}, start.zRate = {-velocity, 0};
  constexpr double h = 0.99 * length;
  const auto scheme = march::masslessScheme(model, start, h);
  double last = 0, impulse = 0;
  while (scheme->state().time < 3) {
    scheme->step();
    if (scheme->state().force[0] > 0) last = scheme->state().time;
    impulse += h * scheme->state().force[0];
  }
  // The wave front is some cells wide; the momentum turns from −v to v.
  EXPECT_NEAR(last, 2, 5 * h);
  EXPECT_NEAR(impulse, 2 * velocity, 0.01 * velocity);
}

// Figures of an independent derivation, to their five digits.
TEST(Regime, TubeHasItsCoefficients) {
  const Tube thin = tubeOf(1.5, 0.3), thick = tubeOf(2, 0.3);
  const double thinExact[] = {0.81684, 0.23338, 0.57143, 14.70171, 6.93642},
               thickExact[] = {0.70857, 0.20245, 0.64898, 4.63913, 2.82283};
  const double thinOurs[] = {thin.a, thin.b, thin.d, thin.g, thin.h},
               thickOurs[] = {thick.a, thick.b, thick.d, thick.g, thick.h};
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(thinOurs[i], thinExact[i], 6e-6) << i;
    EXPECT_NEAR(thickOurs[i], thickExact[i], 6e-6) << i;
  }
}

TEST(Regime, StickSlipWaveIsSolved) {
  const Tube thin = tubeOf(1.5, 0.3), thick = tubeOf(2, 0.3);
  const struct {
    Tube tube;
    int k;
    double f, omega, stick;
  } rows[] = {{thin, 4, 0.4, 4.413618, 0.1714},
              {thin, 8, 0.2, 7.660818, 0.1714},
              {thick, 2, 0.7, 2.175733, 0.3486}};
  for (const auto& row : rows) {
    const Wave wave = waveOf(row.tube, row.k, row.f, row.omega, row.stick);
    EXPECT_NEAR(row.k * wave.c, row.omega, 1e-6);
    EXPECT_NEAR(wave.stickFraction(), row.stick, 6e-5);
  }
}

// With 160 nodes a wavelength, linear cells make a relative error of the order (2π/160)²/24 = 6e-5
// in the frequency, and a front moves from node to node.
TEST(Regime, TubeKeepsItsStickSlipWave) {
  const Tube tube = tubeOf(1.5, 0.3);
  const Wave wave = waveOf(tube, 4, 0.4, 4.4136, 0.1714);
  const TubeModel model = tubeModel(tube, 4, 0.4, 0.5, 160, 0);
  const double period = 2 * M_PI / 4.413618;
  const Marched result =
      marched(model.model, onWave(wave, model.model), period / 1280, 2 * period, 6 * period);
  EXPECT_NEAR(result.omega / 4.413618, 1, 1e-4);
  EXPECT_NEAR(result.stick, 0.1714, 0.01);
  EXPECT_EQ(result.open, 0);
}

// With the contact open, the mass on the belt is [2 1; 1 2/3]: the spring of its end is free. Its
// largest eigenvalue is (4 + √13)/3, and the leapfrog rule is stable up to 2/ω.
TEST(LongestStep, IsThatOfTheOpenContact) {
  auto model = massOnBelt(1);
  const double longest = march::longestStep(model);
  EXPECT_NEAR(longest, 2 / std::sqrt((4 + std::sqrt(13.0)) / 3), 1e-12);
  EXPECT_GT(longest, march::stableStep(model));
  auto& node = model.nodes[0];
  node.normalForce = 0, node.shear = {0, 0}, node.gap = 1e9;
  for (const double factor : {0.99, 1.01}) {
    const auto scheme =
        march::masslessScheme(model, {{0.1, 0.1}, {0, 0}, {0, 0}, {0, 0}}, factor * longest);
    for (int i = 0; i < 60; ++i) scheme->step();
    EXPECT_EQ(scheme->state().kinetic > 1, factor > 1) << scheme->state().kinetic;
  }
}

}  // namespace
}  // namespace squeal
