// SPDX-License-Identifier: BSD-2-Clause
#include "regime/cycles/shooting.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "algebra/linalg/complexdense.hpp"
#include "algebra/linalg/lu.hpp"
#include "base/petsc/check.hpp"
#include "regime/march/products.hpp"

namespace squeal::cycles {
namespace {

constexpr int mostLinearisations = 12;
constexpr double smallestStep = 1.0 / 64;  // of Newton's

/// Relative step of central differences in period and friction.
constexpr double difference = 1e-6;

}  // namespace

Linearisation::Linearisation(const Period& period, const Orbit& at)
    : monodromy_(period.derivative(at)) {
  const ReducedModel& model = period.model();
  for (const double square : model.stiffness) frequency_.push_back(std::sqrt(square));
  scale_ = frequency_;
  scale_.resize(2 * modes(), 1.0);
  for (const PetscInt row : monodromy_.stuck)
    scale_.push_back(std::sqrt(model.boundaryStiffness(row, row)));
  const double norm = cycles::norm(model, at.start);
  periodScale_ = norm / at.period, frictionScale_ = norm / std::max(at.friction, 1e-3);
  byPeriod_ = derivative(period, at, &Orbit::period, periodScale_);
  byFriction_ = derivative(period, at, &Orbit::friction, frictionScale_);
  phase_ = phase(period, at);
}

/// Collective. Returns the scaled derivative of the end with respect to a parameter of the orbit.
Linearisation::EndDerivative Linearisation::derivative(const Period& period, const Orbit& at,
                                                       double Orbit::*parameter,
                                                       double scale) const {
  const PetscInt k = modes();
  Orbit ahead = at, behind = at;
  const double step = difference * cycles::norm(period.model(), at.start) / scale;
  ahead.*parameter += step, behind.*parameter -= step;
  const InitialState to = period.pass(ahead).end, from = period.pass(behind).end;
  const double factor = 1 / (2 * step * scale);
  EndDerivative result;
  for (PetscInt i = 0; i < k; ++i) result.x.push_back((to.q[i] - from.q[i]) * factor * scale_[i]);
  for (PetscInt i = 0; i < k; ++i) result.x.push_back((to.v[i] - from.v[i]) * factor);
  for (std::size_t i = 0; i < to.z.size(); ++i) result.z.push_back((to.z[i] - from.z[i]) * factor);
  for (std::size_t i = 0; i < monodromy_.stuck.size(); ++i)
    result.x.push_back(result.z[monodromy_.stuck[i]] * scale_[2 * k + i]);
  return result;
}

/// Collective. Returns the direction of the motion at the start, 2-norm 1, [entry of x].
std::vector<double> Linearisation::phase(const Period& period, const Orbit& at) const {
  const PetscInt k = modes();
  const InitialState next = period.pass(at, 1).end;
  std::vector<double> phase;
  for (PetscInt i = 0; i < k; ++i) phase.push_back((next.q[i] - at.start.q[i]) * scale_[i]);
  for (PetscInt i = 0; i < k; ++i) phase.push_back(next.v[i] - at.start.v[i]);
  const double length = std::sqrt(march::dot(phase, phase));
  if (!(length > 0)) throw Error("the motion is at rest at the start of a period");
  for (double& entry : phase) entry /= length;
  phase.resize(scale_.size(), 0.0);
  return phase;
}

/// Solves with `last`, a Direction, as the last equation.
std::vector<double> Linearisation::solve(std::vector<double> right, const Direction& last) const {
  const PetscInt n = std::ssize(scale_), k = modes();
  DenseMatrix a(n + 2, n + 2);
  for (PetscInt j = 0; j < n; ++j) {
    for (PetscInt i = 0; i < n; ++i)
      a(i, j) = monodromy_.end(i, j) * scale_[i] / scale_[j] - (i == j);
    a(n, j) = phase_[j];
    a(n + 1, j) = j < 2 * k ? last[j] : 0;
  }
  for (PetscInt i = 0; i < n; ++i) a(i, n) = byPeriod_.x[i], a(i, n + 1) = byFriction_.x[i];
  a(n + 1, n) = last[2 * k], a(n + 1, n + 1) = last[2 * k + 1];
  linalg::Lu<double>(std::move(a)).solve(std::span(right));
  return right;
}

Linearisation::Step Linearisation::step(const InitialState& start, const InitialState& end,
                                        const Direction& tangent) const {
  const PetscInt n = std::ssize(scale_), k = modes();
  std::vector<double> right(n + 2);
  for (PetscInt i = 0; i < k; ++i) right[i] = (start.q[i] - end.q[i]) * scale_[i];
  for (PetscInt i = 0; i < k; ++i) right[k + i] = start.v[i] - end.v[i];
  for (PetscInt i = 2 * k; i < n; ++i) {
    const PetscInt row = monodromy_.stuck[i - 2 * k];
    right[i] = (start.z[row] - end.z[row]) * scale_[i];
  }
  Direction last = tangent;
  if (last.empty()) last.resize(2 * k + 2), last.back() = 1;
  const auto x = solve(std::move(right), last);
  Step result;
  result.direction.assign(x.begin(), x.begin() + 2 * k);
  result.direction.push_back(x[n]), result.direction.push_back(x[n + 1]);
  result.z.assign(start.z.size(), 0);
  for (PetscInt j = 0; j < n; ++j) {
    const double entry = x[j] / scale_[j];
    if (j >= 2 * k) result.stuck.push_back(entry);
    for (std::size_t i = 0; i < result.z.size(); ++i) result.z[i] += monodromy_.z(i, j) * entry;
  }
  for (std::size_t i = 0; i < result.z.size(); ++i)
    result.z[i] += byPeriod_.z[i] * x[n] + byFriction_.z[i] * x[n + 1];
  return result;
}

Direction Linearisation::tangent(const Direction& near) const {
  const PetscInt n = std::ssize(scale_), k = modes();
  std::vector<double> right(n + 2);
  right.back() = 1;
  const auto x = solve(std::move(right), near);
  Direction result(x.begin(), x.begin() + 2 * k);
  result.push_back(x[n]), result.push_back(x[n + 1]);
  const double length = std::sqrt(march::dot(result, result));
  for (double& entry : result) entry /= length;
  return result;
}

Multipliers Linearisation::multipliers() const {
  const PetscInt n = std::ssize(scale_);
  linalg::ComplexMatrix a(n, n);
  for (PetscInt j = 0; j < n; ++j)
    for (PetscInt i = 0; i < n; ++i) a(i, j) = monodromy_.end(i, j) * scale_[i] / scale_[j];
  const auto eigen = linalg::eigen(std::move(a));
  std::vector<PetscInt> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, [&](PetscInt i, PetscInt j) {
    return std::pair(std::abs(eigen.value[i]), eigen.value[i].imag()) >
           std::pair(std::abs(eigen.value[j]), eigen.value[j].imag());
  });
  Multipliers result;
  double best = -2;
  for (PetscInt place = 0; place < n; ++place) {
    result.values.push_back(eigen.value[order[place]]);
    // The eigenvector of a shift in time is the velocity of the motion.
    Complex along = 0;
    for (PetscInt i = 0; i < n; ++i) along += phase_[i] * eigen.right(i, order[place]);
    const bool near = std::abs(result.values.back() - 1.0) < 0.1;
    const double overlap = near ? std::abs(along) : -1;
    if (overlap > best) best = overlap, result.trivial = place;
  }
  return result;
}

Orbit Linearisation::along(const Orbit& orbit, const Direction& direction, double factor) const {
  Orbit result = orbit;
  const PetscInt k = modes();
  for (PetscInt i = 0; i < k; ++i) {
    result.start.q[i] += factor * direction[i] / scale_[i];
    result.start.v[i] += factor * direction[k + i];
  }
  result.period += factor * direction[2 * k] / periodScale_;
  result.friction += factor * direction[2 * k + 1] / frictionScale_;
  return result;
}

Orbit Linearisation::changed(const Orbit& orbit, const InitialState& end, const Step& step,
                             double factor) const {
  Orbit result = along(orbit, step.direction, factor);
  auto& z = result.start.z;
  std::vector<unsigned char> sticks(z.size());
  for (const PetscInt row : monodromy_.stuck) sticks[row] = 1;
  // A slip that does not stick gets its value at the end of the period.
  for (std::size_t i = 0; i < z.size(); ++i)
    if (!sticks[i]) z[i] += factor * (end.z[i] - z[i] + step.z[i]);
  for (std::size_t i = 0; i < step.stuck.size(); ++i)
    z[monodromy_.stuck[i]] += factor * step.stuck[i];
  return result;
}

namespace {

/// Newton's method with damping and with reused linearisations.
class Newton {
 public:
  Newton(const Period& period, const Orbit& guess, const ShootingRequest& request)
      : period_(period),
        request_(request),
        linearisation_(request.linearisation),
        passage_(period.pass(guess)) {
    result_.orbit = guess;
    result_.change = cycles::change(period.model(), guess.start, passage_.end);
  }

  ShootingResult solve() {
    while (result_.change > request_.tolerance) {
      if (!linearisation_) renew();
      if (improve()) {
        fresh_ = false;
        report();
        if (linearisation_ || result_.derivatives < mostLinearisations) continue;
        break;
      }
      if (fresh_ || result_.derivatives >= mostLinearisations) break;
      linearisation_.reset();
    }
    result_.measures = passage_.measures;
    result_.converged = result_.change <= request_.tolerance;
    if (result_.converged) renew(), result_.linearisation = linearisation_;
    return std::move(result_);
  }

 private:
  void report() const {
    if (request_.progress) request_.progress({result_.change, result_.derivatives});
  }
  void renew() {
    report();
    linearisation_ = std::make_shared<const Linearisation>(period_, result_.orbit);
    ++result_.derivatives;
    fresh_ = true;
  }

  /// Takes a step that reduces the change over a period. Returns false if there is none.
  bool improve() {
    const auto step = linearisation_->step(result_.orbit.start, passage_.end, request_.tangent);
    for (double factor = 1; factor >= (fresh_ ? smallestStep : 1); factor /= 2) {
      const Orbit trial = linearisation_->changed(result_.orbit, passage_.end, step, factor);
      if (!(trial.period > 0 && trial.friction > 0)) continue;
      try {
        Passage there = period_.pass(trial);
        const double change = cycles::change(period_.model(), trial.start, there.end);
        if (!(change < (1 - factor / 10) * result_.change)) continue;
        // A linearisation is reused only while convergence is fast.
        const bool slow = change > result_.change / 4;
        result_.orbit = trial, result_.change = change, passage_ = std::move(there);
        if (slow) linearisation_.reset();
        return true;
      } catch (const Error&) {  // the motion is unbounded
      }
    }
    return false;
  }

  const Period& period_;
  const ShootingRequest& request_;
  std::shared_ptr<const Linearisation> linearisation_;
  bool fresh_ = false;  // the linearisation belongs to the orbit of the result
  Passage passage_;     // of that orbit
  ShootingResult result_;
};

}  // namespace

ShootingResult shoot(const Period& period, const Orbit& guess, const ShootingRequest& request) {
  return Newton(period, guess, request).solve();
}

}  // namespace squeal::cycles
