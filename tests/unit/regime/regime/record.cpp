// SPDX-License-Identifier: BSD-2-Clause
// What a recorder says of motions that are made by hand, and first events in closed form.
#include "regime/regime/record.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "regime/march/onset.hpp"
#include "support/algebra/dense.hpp"

namespace squeal {
namespace {

constexpr double frequency = 1000, timeStep = 1 / frequency / 64, onset = 1;
const Complex mode(10, 2 * M_PI * frequency);

march::ReducedModel oneNode() {
  march::ReducedModel model;
  model.dimension = 2;
  model.nodes.resize(1);
  auto& node = model.nodes[0];
  node.friction = 0.5, node.normalForce = 2, node.area = 0.1;
  node.shear = {-1, 0}, node.velocity = {1, 0};
  model.stiffness = {std::norm(mode)};
  model.moves = {1, 1};
  return model;
}

/// A motion whose velocity has a given amplitude, and whose nodes are open for a quarter of each
/// period where the kinetic energy passes that of the onset.
class ByHand : public march::Scheme {
 public:
  ByHand(const march::ReducedModel& model, std::function<double(double)> amplitude)
      : Scheme(model), nodes_(model.nodes.size()), amplitude_(std::move(amplitude)) {
    stiffness_.assign(nodes_, 1);
    increments_ = state_.jump = ofEach(0, 0);
    state_.v = {0};
  }
  void step() override {
    state_.time += timeStep;
    const double phase = 2 * M_PI * frequency * state_.time, a = amplitude_(state_.time);
    state_.v[0] = a * std::cos(phase);
    state_.kinetic = state_.v[0] * state_.v[0] / 2;
    const bool open = a * a / 2 > onset && std::sin(phase) > std::sqrt(0.5);
    state_.force = open ? ofEach(0, 0) : ofEach(2, -1);
    increments_ = open ? ofEach(1, 1) : ofEach(0, 1);
  }
  double energy() const override { return 0; }

 private:
  std::vector<double> ofEach(double normal, double tangential) const {
    std::vector<double> rows;
    for (std::size_t i = 0; i < nodes_; ++i) rows.insert(rows.end(), {normal, tangential});
    return rows;
  }
  std::size_t nodes_;
  std::function<double(double)> amplitude_;
};

regime::Regime recorded(const std::function<double(double)>& amplitude, double time,
                        march::ReducedModel model = oneNode()) {
  ByHand motion(model, amplitude);
  regime::Recorder recorder(model, mode, timeStep, onset);
  while (motion.state().time < time) {
    motion.step();
    recorder.inspect(motion);
  }
  return recorder.result(motion);
}

TEST(Recorder, LinearGrowthIsMeasured) {
  const auto regime = recorded([](double t) { return 1e-3 * std::exp(10 * t); }, 0.2);
  EXPECT_EQ(regime.kind, regime::Kind::growing);
  EXPECT_FALSE(regime.settled);
  // The largest of 64 values a period lies below the peak by up to (π/64)² of it, alike in all.
  EXPECT_NEAR(regime.growth, 10, 0.01);
}

// A window has 32 cycles, 0.032 s.
TEST(Recorder, LessThanAWindowMeasuresNothing) {
  const auto regime = recorded([](double t) { return 1e-3 * std::exp(10 * t); }, 0.03);
  EXPECT_FALSE(regime.measured());
  EXPECT_STREQ(regime::text(regime.kind), "nothing measured");
  EXPECT_TRUE(regime.nodes.empty() && regime.cyclePeaks.empty() && regime.spectrum.empty());
  EXPECT_TRUE(recorded([](double t) { return 1e-3 * std::exp(10 * t); }, 0.0325).measured());
}

TEST(Recorder, DecayIsSteady) {
  EXPECT_EQ(recorded([](double t) { return 1e-1 * std::exp(-50 * t); }, 0.4).kind,
            regime::Kind::steady);
}

// After 0.1 s of growth the amplitude stays: a quarter of each period open, three quarters sliding.
TEST(Recorder, EqualCyclesArePeriodic) {
  const auto regime = recorded([](double t) { return std::min(2.0, 0.5 * std::exp(20 * t)); }, 1);
  EXPECT_EQ(regime.kind, regime::Kind::periodic);
  EXPECT_TRUE(regime.settled);
  EXPECT_NEAR(regime.carrier, frequency, 0.5);
  EXPECT_NEAR(regime.nodes[0].open, 0.25, 0.02);
  EXPECT_NEAR(regime.nodes[0].slip, 0.75, 0.02);
  EXPECT_EQ(regime.nodes[0].stick, 0);
  // Force 2 for three quarters of the time on 0.1 m², sliding with 1 m/s against half of it.
  EXPECT_NEAR(regime.nodes[0].pressure, 0.75 * 2 / 0.1, 0.4);
  EXPECT_NEAR(regime.means.frictionPower, 0.75, 0.02);
  EXPECT_NEAR(regime.means.frictionCoefficient, 0.5, 1e-12);
  EXPECT_NEAR(regime.largestKinetic, 2, 0.01);
}

// A second node, of an interface that sticks, carries the same forces.
TEST(Recorder, OnlySlidingNodesHaveACoefficient) {
  auto model = oneNode();
  model.nodes.push_back(model.nodes[0]);
  model.nodes[1].velocity = {0, 0};
  model.moves = {1, 1, 1, 1};
  const auto regime = recorded([](double) { return 2.0; }, 1, model);
  EXPECT_NEAR(regime.means.frictionCoefficient, 0.5, 1e-12);
}

TEST(Recorder, BeatsAreModulated) {
  const auto regime = recorded([](double t) { return 2 + 0.4 * std::sin(2 * M_PI * 37 * t); }, 1);
  EXPECT_EQ(regime.kind, regime::Kind::modulated);
  EXPECT_NEAR(regime.modulation, 37, 0.5);
  // (2 + 0.4 sin)² has the standard deviation 1.6 / √2 over the mean 4.08.
  EXPECT_NEAR(regime.peakDeviation, 1.6 / std::sqrt(2) / 4.08, 0.01);
}

TEST(Recorder, CyclesWithoutRuleAreIrregular) {
  std::mt19937 generator(5);
  std::vector<double> amplitudes;
  for (int cycle = 0; cycle < 2000; ++cycle)
    amplitudes.push_back(2 + 0.5 * test::uniform(generator));
  const auto regime =
      recorded([&](double t) { return amplitudes.at(std::size_t(t * frequency)); }, 1);
  EXPECT_EQ(regime.kind, regime::Kind::irregular);
}

// Of two nodes the second opens at a fifth of the force; the first would come to rest at 1/0.5.
TEST(Onset, IsTheFirstEventOfAllNodes) {
  std::vector<march::Node> nodes(2);
  for (auto& node : nodes) {
    node.friction = 0.4, node.normalForce = 10;
    node.shear = {-4, 0}, node.velocity = {1, 0};
  }
  std::vector<march::NodeMotion> motion(2);
  motion[0].rate = {Complex(0.3, 0.4), Complex(0, 0.1)};
  motion[1].normalForce = Complex(30, -40);
  auto first = march::firstEvent(nodes, motion);
  EXPECT_EQ(first.event, march::OnsetEvent::opens);
  EXPECT_EQ(first.node, 1u);
  EXPECT_NEAR(first.factor, 0.2, 1e-15);
  EXPECT_NEAR(first.turning, 0.02, 1e-15);
  motion[1].normalForce = 1;
  first = march::firstEvent(nodes, motion);
  EXPECT_EQ(first.event, march::OnsetEvent::rests);
  EXPECT_NEAR(first.factor, 2, 1e-15);
}

// A node that sticks under R_T = (3, 0) with f R_N = 5: along the force it slides at a change of 2;
// where R_N falls alike, f R_N − x f·2 = 3 + x at x = 2 / (1 + 0.5 · 2).
TEST(Onset, OfANodeThatSticks) {
  std::vector<march::Node> nodes(1);
  nodes[0].friction = 0.5, nodes[0].normalForce = 10, nodes[0].shear = {3, 0};
  std::vector<march::NodeMotion> motion(1);
  motion[0].shear = {Complex(1), Complex(0)};
  auto first = march::firstEvent(nodes, motion);
  EXPECT_EQ(first.event, march::OnsetEvent::slides);
  EXPECT_NEAR(first.factor, 2, 1e-12);
  motion[0].normalForce = -2;
  EXPECT_NEAR(march::firstEvent(nodes, motion).factor, 1, 1e-12);
}

}  // namespace
}  // namespace squeal
