// SPDX-License-Identifier: BSD-2-Clause
#include "regime/cycles/section.hpp"

#include <utility>
#include <vector>

#include "regime/march/products.hpp"

namespace squeal::cycles {
namespace {

void addTo(std::vector<double>& sum, const std::vector<double>& x) {
  if (sum.empty()) sum.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) sum[i] += x[i];
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = a[i] - b[i];
  return result;
}

/// Returns true if each node is open, sticks or slides as in steady sliding.
bool isLinear(const ReducedModel& model, const march::Massless& scheme) {
  const auto stuck = scheme.stuck();
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const auto& node = model.nodes[i];
    const PetscInt row = i * model.dimension;
    const bool open = scheme.state().force[row] == 0;
    if (open == node.pressed() || (!open && node.hasFriction() && stuck[row + 1] != node.sticks()))
      return false;
  }
  return true;
}

}  // namespace

// These list all members: a new one does not compile until it is added here.
void fields(Stream& stream, Pass& pass) {
  auto& [state, acceleration, period] = pass;
  stream(state, acceleration, period);
}

void fields(Stream& stream, Passes& passes) {
  auto& [count, sum, nearest, change] = passes;
  stream(count, sum, nearest, change);
}

void Passes::add(const Passes& other) {
  if (other.count == 0) return;
  addTo(sum.state.q, other.sum.state.q), addTo(sum.state.v, other.sum.state.v);
  addTo(sum.state.z, other.sum.state.z), addTo(sum.acceleration, other.sum.acceleration);
  sum.period += other.sum.period, count += other.count;
  if (other.change >= 0 && (change < 0 || other.change < change))
    change = other.change, nearest = other.nearest;
}

Section::Section(const ReducedModel& model, const std::vector<Complex>& q, double period)
    : model_(model), period_(period) {
  for (std::size_t i = 0; i < q.size(); ++i) weight_.push_back(model.stiffness[i] * q[i].real());
}

void Section::inspect(const march::Massless& scheme) {
  InitialState now = scheme.next();
  const double time = scheme.state().time, level = march::dot(weight_, now.q);
  if (linear_) linear_ = isLinear(model_, scheme);
  if (!last_.q.empty() && before_ < 0 && level >= 0) {
    const double part = before_ / (before_ - level), at = lastTime_ + part * (time - lastTime_);
    const auto between = [&](const std::vector<double>& a, const std::vector<double>& b) {
      std::vector<double> result(a.size());
      for (std::size_t i = 0; i < a.size(); ++i) result[i] = a[i] + part * (b[i] - a[i]);
      return result;
    };
    Pass pass{{between(last_.q, now.q), between(last_.v, now.v), between(last_.z, now.z)},
              difference(now.v, last_.v),
              at - lastPassTime_};
    for (double& entry : pass.acceleration) entry /= time - lastTime_;
    if (lastPassTime_ >= 0 && pass.period > 0.5 * period_ && pass.period < 2 * period_) {
      Passes one{1, pass, {}, -1};
      if (!linear_) one.nearest = pass, one.change = change(model_, lastPass_, pass.state);
      passes_.add(one);
    }
    lastPass_ = std::move(pass.state), lastPassTime_ = at, linear_ = true;
  }
  before_ = level, last_ = std::move(now), lastTime_ = time;
}

std::vector<Orbit> firstOrbits(const Passes& passes, double step, int steps) {
  std::vector<Orbit> orbits;
  const auto append = [&](const Pass& pass, int count) {
    Orbit orbit{pass.state, pass.period / count, 0};
    for (auto* part : {&orbit.start.q, &orbit.start.v, &orbit.start.z})
      for (double& entry : *part) entry /= count;
    // v belongs to half a step earlier.
    for (std::size_t i = 0; i < orbit.start.v.size(); ++i)
      orbit.start.v[i] += (step - orbit.period / steps) / 2 * pass.acceleration[i] / count;
    orbits.push_back(std::move(orbit));
  };
  if (passes.count > 0) append(passes.sum, passes.count);
  if (passes.change >= 0) append(passes.nearest, 1);
  return orbits;
}

}  // namespace squeal::cycles
