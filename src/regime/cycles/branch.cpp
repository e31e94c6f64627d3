// SPDX-License-Identifier: BSD-2-Clause
#include "regime/cycles/branch.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/petsc/check.hpp"

namespace squeal::cycles {
namespace {

/// Returns the extremum of the cubic through two values with these slopes, a distance apart.
double turningPoint(double f0, double slope0, double f1, double slope1, double distance) {
  // f = f0 + distance (slope0 t + b t² + a t³), with its extremum at 0 < t < 1.
  const double mean = (f1 - f0) / distance, a = slope0 + slope1 - 2 * mean,
               b = 3 * mean - 2 * slope0 - slope1;
  // The root of 3 a t² + 2 b t + slope0 in the form that does not cancel.
  const double root = std::sqrt(std::max(0.0, b * b - 3 * a * slope0));
  const double t = -slope0 / (b + std::copysign(root, slope0 < 0 ? 1 : -1));
  return f0 + distance * t * (slope0 + t * (b + t * a));
}

/// Returns the next motion for a guess on the tangent, and sets the reason if there is none.
ShootingResult correct(const Period& period, const Orbit& guess, const ShootingRequest& request,
                       std::string& failure) {
  if (!(guess.friction > 0)) return {};
  try {
    return shoot(period, guess, request);
  } catch (const Error& error) {  // the motion is unbounded: a shorter step may succeed
    failure = std::string(": ") + error.what();
    return {};
  }
}

/// Returns why the branch ends at a motion; empty if it does not.
std::string endAt(const ShootingResult& motion, const ContinuationLimits& limits) {
  const double friction = motion.orbit.friction;
  if (friction < limits.lowest || friction > limits.highest) return "the end of the range";
  if (motion.measures.linear) return "no node separates or sticks";
  return "";
}

}  // namespace

Route continueBranch(const Period& period, const ShootingResult& first, bool upwards,
                     const ContinuationLimits& limits, const Progress& progress,
                     const std::function<void(const ShootingResult&)>& inspect) {
  Route route;
  ShootingResult last = first;
  Direction tangent(2 * period.model().modes() + 2);
  tangent.back() = upwards ? 1 : -1;
  tangent = last.linearisation->tangent(tangent);
  // The length of a step along the branch, relative to the norm of the motion.
  constexpr double firstStep = 0.02, shortest = 1e-4, longest = 0.2;
  int motions = 0;
  for (double length = firstStep; motions < limits.most;) {
    route.end = last.orbit.friction;
    const double step = length * norm(period.model(), last.orbit.start);
    const Orbit guess = last.linearisation->along(last.orbit, tangent, step);
    std::string failure;
    ShootingResult next =
        correct(period, guess, {limits.tolerance, progress, tangent, last.linearisation}, failure);
    if (!next.converged) {
      length /= 2;
      if (length >= shortest) continue;
      route.reason = "Newton's method fails" + failure;
      return route;
    }
    if (route.reason = endAt(next, limits); !route.reason.empty()) {
      route.end = std::clamp(next.orbit.friction, limits.lowest, limits.highest);
      return route;
    }
    if (next.derivatives <= 2) length = std::min(longest, 1.5 * length);
    if (next.derivatives > 4) length /= 2;
    const double before = last.linearisation->frictionAlong(tangent);
    tangent = next.linearisation->tangent(tangent);
    if (const double after = next.linearisation->frictionAlong(tangent); before * after < 0)
      route.folds.push_back(
          turningPoint(last.orbit.friction, before, next.orbit.friction, after, step));
    inspect(next);
    last = std::move(next);
    ++motions;
  }
  route.end = last.orbit.friction;
  route.reason = "the largest number of motions is reached";
  return route;
}

}  // namespace squeal::cycles
