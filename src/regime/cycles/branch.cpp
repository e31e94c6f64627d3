#include "regime/cycles/branch.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/petsc/check.hpp"

namespace squeal::cycles {
namespace {

/// Returns where the cubic through two values with these slopes, a distance apart, turns back.
double turningPoint(double f0, double slope0, double f1, double slope1, double distance) {
  // f = f0 + distance (slope0 t + b t² + a t³), with its extremum at 0 < t < 1.
  const double mean = (f1 - f0) / distance, a = slope0 + slope1 - 2 * mean,
               b = 3 * mean - 2 * slope0 - slope1;
  // The root of 3 a t² + 2 b t + slope0 in the form that does not cancel.
  const double root = std::sqrt(std::max(0.0, b * b - 3 * a * slope0));
  const double t = -slope0 / (b + std::copysign(root, slope0 < 0 ? 1 : -1));
  return f0 + distance * t * (slope0 + t * (b + t * a));
}

}  // namespace

Way follow(Period& period, const Found& first, bool upwards, const Reach& reach, const Told& told,
           const std::function<void(const Found&)>& look) {
  Way way;
  Found last = first;
  Direction tangent(2 * period.model().modes() + 2);
  tangent.back() = upwards ? 1 : -1;
  tangent = last.linearisation->tangent(tangent);
  // The length of a step along the branch, relative to the norm of the motion.
  constexpr double firstStep = 0.02, shortest = 1e-4, longest = 0.2;
  int motions = 0;
  for (double length = firstStep; motions < reach.most;) {
    way.end = last.orbit.friction;
    const double step = length * norm(period.model(), last.orbit.start);
    const Orbit guess = last.linearisation->along(last.orbit, tangent, step);
    Found next;
    std::string failure;
    if (guess.friction > 0) try {
        next = shoot(period, guess, reach.tolerance, told, tangent, last.linearisation);
      } catch (const Error& error) {  // a motion without bound: a shorter step may find one
        next = {}, failure = std::string(": ") + error.what();
      }
    if (!next.converged) {
      length /= 2;
      if (length >= shortest) continue;
      way.reason = "Newton's method fails" + failure;
      return way;
    }
    if (next.orbit.friction < reach.lowest || next.orbit.friction > reach.highest) {
      way.end = std::clamp(next.orbit.friction, reach.lowest, reach.highest);
      way.reason = "the end of the range";
      return way;
    }
    if (next.measures.linear) {
      way.end = next.orbit.friction;
      way.reason = "the motion touches no limit of the contact";
      return way;
    }
    if (next.derivatives <= 2) length = std::min(longest, 1.5 * length);
    if (next.derivatives > 4) length /= 2;
    const double before = last.linearisation->frictionAlong(tangent);
    tangent = next.linearisation->tangent(tangent);
    if (const double after = next.linearisation->frictionAlong(tangent); before * after < 0)
      way.folds.push_back(
          turningPoint(last.orbit.friction, before, next.orbit.friction, after, step));
    look(next);
    last = std::move(next);
    ++motions;
  }
  way.end = last.orbit.friction;
  way.reason = "the most motions that are wanted";
  return way;
}

}  // namespace squeal::cycles
