// SPDX-License-Identifier: BSD-2-Clause
#include "regime/march/onset.hpp"

#include <cmath>
#include <limits>

namespace squeal::march {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Returns the smallest factor x ≥ 0 with |a + x b| = limit + x c, |a| ≤ limit, in the plane.
double reaches(const std::array<double, 2>& a, const std::array<double, 2>& b, double limit,
               double c) {
  const double two = b[0] * b[0] + b[1] * b[1] - c * c, one = a[0] * b[0] + a[1] * b[1] - limit * c,
               zero = std::min(0.0, a[0] * a[0] + a[1] * a[1] - limit * limit);
  if (zero == 0) return one > 0 || (one == 0 && two > 0) ? 0 : never;
  const double root = one * one - two * zero;
  if (root < 0) return never;
  // two x² + 2 one x + zero = 0 with zero < 0.
  const double x = -zero / (one + std::sqrt(root));
  return x > 0 ? x : never;
}

/// Returns the smallest factor at which a sticking node slides at some phase.
double slides(const Node& node, const NodeMotion& motion) {
  if (!std::isfinite(node.friction)) return never;
  double first = never;
  constexpr int phases = 180;
  for (int k = 0; k < phases; ++k) {
    const Complex turn = std::polar(1.0, 2 * M_PI * k / phases);
    std::array<double, 2> change{};
    for (int c = 0; c < 2; ++c) change[c] = (turn * motion.shear[c]).real();
    first = std::min(first, reaches(node.shear, change, node.friction * node.normalForce,
                                    node.friction * (turn * motion.normalForce).real()));
  }
  return first;
}

}  // namespace

const char* text(OnsetEvent event) {
  constexpr const char* texts[] = {"none", "opens", "comes_to_rest", "slides"};
  return texts[static_cast<int>(event)];
}

Onset firstEvent(std::span<const Node> nodes, std::span<const NodeMotion> motion) {
  Onset onset;
  onset.factor = never;
  const auto consider = [&](double factor, OnsetEvent event, std::size_t node) {
    if (factor < onset.factor) onset = {event, factor, node, 0};
  };
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Node& node = nodes[i];
    if (!node.pressed()) continue;
    if (const double size = std::abs(motion[i].normalForce); size > 0)
      consider(node.normalForce / size, OnsetEvent::opens, i);
    if (!node.hasFriction()) continue;
    if (node.sticks()) {
      consider(slides(node, motion[i]), OnsetEvent::slides, i);
    } else if (const double size = std::abs(motion[i].rate[0]); size > 0) {
      consider(node.velocity[0] / size, OnsetEvent::rests, i);
    }
  }
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].pressed() && !nodes[i].sticks() && std::isfinite(onset.factor))
      onset.turning = std::max(onset.turning,
                               onset.factor * std::abs(motion[i].rate[1]) / nodes[i].velocity[0]);
  return onset;
}

std::vector<NodeMotion> motionAt(const ReducedModel& model, const LinearMode& mode) {
  std::vector<NodeMotion> motion(model.nodes.size());
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const PetscInt row = i * model.dimension;
    motion[i].normalForce = mode.force[row];
    for (int c = 1; c < model.dimension; ++c) {
      motion[i].shear[c - 1] = mode.force[row + c];
      motion[i].rate[c - 1] = mode.s * mode.jump[row + c];
    }
  }
  return motion;
}

double largestKinetic(const LinearMode& mode) {
  double squares = 0;
  Complex product = 0;
  for (const Complex q : mode.q) {
    const Complex v = mode.s * q;
    squares += std::norm(v), product += v * v;
  }
  return (squares + std::abs(product)) / 4;
}

}  // namespace squeal::march
