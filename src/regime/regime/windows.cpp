// SPDX-License-Identifier: BSD-2-Clause
#include "regime/regime/windows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace squeal::regime {

using march::Node;
using march::State;

WindowRecorder::WindowRecorder(const ReducedModel& model) : model_(model) {
  int pressed = 0;
  for (const Node& node : model.nodes) meanForce_ += node.normalForce, pressed += node.pressed();
  meanForce_ /= std::max(1, pressed);
  window_.nodes.resize(model.nodes.size());
}

void WindowRecorder::inspect(const Scheme& scheme) {
  ++steps_;
  window_.means.kinetic += scheme.state().kinetic;
  for (std::size_t i = 0; i < model_.nodes.size(); ++i) inspectNode(i, scheme);
}

void WindowRecorder::inspectNode(std::size_t i, const Scheme& scheme) {
  const State& state = scheme.state();
  const PetscInt row = i * model_.dimension;
  const Node& node = model_.nodes[i];
  Means& all = window_.means;
  NodeMeans& means = window_.nodes[i];
  const double normal = state.force[row];
  double heat = 0, shear = 0, change = 0;  // the last two squared
  for (int c = 1; c < model_.dimension; ++c) {
    const double w = state.rate[row + c], w0 = node.velocity[c - 1];
    const double t = state.force[row + c];
    heat -= t * w;
    shear += t * t, change += (w - w0) * (w - w0);
  }
  // The friction force of a sliding node is on the cone, within the accuracy of the forces.
  const bool open = normal == 0,
             sticks = !open && node.hasFriction() &&
                      std::sqrt(shear) < scheme.friction()[i] * (normal - 1e-5 * meanForce_);
  means.open += open, means.stick += sticks, means.slip += !open && !sticks;
  all.open += open, all.sticking += sticks;
  if (open == node.pressed() || (!open && node.hasFriction() && sticks != node.sticks()))
    all.linear = false;
  means.pressure += normal;
  means.largestGap = std::max(means.largestGap, node.gap + state.jump[row]);
  means.power += heat;
  all.frictionPower += heat;
  if (node.slides()) normalSum_ += normal, alongSum_ -= state.force[row + 1];
  window_.largestJump = std::max(window_.largestJump, std::abs(state.jump[row]));
  window_.largestVelocity = std::max(window_.largestVelocity, std::sqrt(change));
}

void WindowRecorder::end(double time, double peakKinetic) {
  Means& all = window_.means;
  all.to = time;
  for (double* sum : {&all.kinetic, &all.frictionPower, &all.open, &all.sticking}) *sum /= steps_;
  all.frictionCoefficient = normalSum_ > 0 ? alongSum_ / normalSum_ : 0;
  all.peakKinetic = peakKinetic;
  for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
    NodeMeans& node = window_.nodes[i];
    for (double* sum : {&node.open, &node.stick, &node.slip, &node.power}) *sum /= steps_;
    node.pressure /= steps_ * model_.nodes[i].area;
  }
  Window next;
  next.means.from = time;
  next.nodes.resize(model_.nodes.size());
  windows_.push_back(std::exchange(window_, std::move(next)));
  normalSum_ = alongSum_ = 0;
  steps_ = 0;
}

}  // namespace squeal::regime
