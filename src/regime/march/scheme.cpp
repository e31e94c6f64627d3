// SPDX-License-Identifier: BSD-2-Clause
#include "regime/march/scheme.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/linalg/dense.hpp"

namespace squeal::march {

Scheme::Scheme(const ReducedModel& model, double sweptChange)
    : model_(model),
      sweptChange_(sweptChange),
      steadyForce_(model.rows()),
      steadyVelocity_(model.rows()),
      steadyGap_(model.rows()) {
  double sum = 0;
  int pressed = 0;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    const PetscInt row = i * model.dimension;
    friction_.push_back(
        coefficient(model, node, std::hypot(node.velocity[0], node.velocity[1]), sweptChange));
    steadyForce_[row] = node.normalForce;
    steadyGap_[row] = node.gap;
    for (int c = 1; c < model.dimension; ++c)
      steadyForce_[row + c] = node.shear[c - 1], steadyVelocity_[row + c] = node.velocity[c - 1];
    sum += node.normalForce, pressed += node.pressed();
  }
  tolerance_ = accuracy * sum / std::max(1, pressed);
  state_.force = steadyForce_;
  state_.rate = steadyVelocity_;
}

/// Sets the coefficients of friction from the sliding velocities of the preceding step; the error
/// is of the order of the time step. A node at rest has φ(0).
void Scheme::updateFriction() {
  if (!model_.law) return;
  for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
    const PetscInt row = i * model_.dimension;
    const double across = model_.dimension > 2 ? state_.rate[row + 2] : 0;
    friction_[i] = coefficient(model_, model_.nodes[i], std::hypot(state_.rate[row + 1], across),
                               sweptChange_);
  }
}

double Scheme::lastDefect() const {
  return defect(model_.dimension, model_.moves, friction_, state_.force, increments_, stiffness_);
}

Start startOn(const LinearMode& mode, double factor) {
  Start start;
  for (const Complex q : mode.q) {
    start.q.push_back(factor * q.real());
    start.v.push_back(factor * (mode.s * q).real());
    start.acceleration.push_back(factor * (mode.s * mode.s * q).real());
  }
  for (const Complex z : mode.z)
    start.z.push_back(factor * z.real()), start.zRate.push_back(factor * (mode.s * z).real());
  return start;
}

}  // namespace squeal::march
