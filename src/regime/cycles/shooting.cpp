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

/// The part of period and friction by which derivatives are taken.
constexpr double difference = 1e-6;

}  // namespace

Linearisation::Linearisation(Period& period, const Orbit& at) : monodromy_(period.derivative(at)) {
  const ReducedModel& model = period.model();
  const PetscInt k = model.modes();
  for (const double square : model.stiffness) frequency_.push_back(std::sqrt(square));
  scale_ = frequency_;
  scale_.resize(2 * k, 1.0);
  for (const PetscInt row : monodromy_.stuck)
    scale_.push_back(std::sqrt(model.boundaryStiffness(row, row)));
  const double norm = cycles::norm(period.model(), at.start);
  periodScale_ = norm / at.period, frictionScale_ = norm / std::max(at.friction, 1e-3);

  const auto derivative = [&](double Orbit::*parameter, double scale, std::vector<double>& all,
                              std::vector<double>& z) {
    Orbit ahead = at, behind = at;
    const double step = difference * norm / scale;
    ahead.*parameter += step, behind.*parameter -= step;
    const Handed to = period.pass(ahead).end, from = period.pass(behind).end;
    const double factor = 1 / (2 * step * scale);
    for (PetscInt i = 0; i < k; ++i) all.push_back((to.q[i] - from.q[i]) * factor * scale_[i]);
    for (PetscInt i = 0; i < k; ++i) all.push_back((to.v[i] - from.v[i]) * factor);
    for (std::size_t i = 0; i < to.z.size(); ++i) z.push_back((to.z[i] - from.z[i]) * factor);
    for (std::size_t i = 0; i < monodromy_.stuck.size(); ++i)
      all.push_back(z[monodromy_.stuck[i]] * scale_[2 * k + i]);
  };
  derivative(&Orbit::period, periodScale_, byPeriod_, zByPeriod_);
  derivative(&Orbit::friction, frictionScale_, byFriction_, zByFriction_);

  const Handed next = period.pass(at, 1).end;
  for (PetscInt i = 0; i < k; ++i) phase_.push_back((next.q[i] - at.start.q[i]) * scale_[i]);
  for (PetscInt i = 0; i < k; ++i) phase_.push_back(next.v[i] - at.start.v[i]);
  const double length = std::sqrt(march::dot(phase_, phase_));
  for (double& entry : phase_) entry /= length;
  phase_.resize(scale_.size(), 0.0);
}

/// Solves with a last equation; `last` is a Direction.
std::vector<double> Linearisation::solve(std::vector<double> right, const Direction& last) const {
  const PetscInt n = std::ssize(scale_), k = modes();
  DenseMatrix a(n + 2, n + 2);
  for (PetscInt j = 0; j < n; ++j) {
    for (PetscInt i = 0; i < n; ++i)
      a(i, j) = monodromy_.end(i, j) * scale_[i] / scale_[j] - (i == j);
    a(n, j) = phase_[j];
    a(n + 1, j) = j < 2 * k ? last[j] : 0;
  }
  for (PetscInt i = 0; i < n; ++i) a(i, n) = byPeriod_[i], a(i, n + 1) = byFriction_[i];
  a(n + 1, n) = last[2 * k], a(n + 1, n + 1) = last[2 * k + 1];
  linalg::Lu<double>(std::move(a)).solve(std::span(right));
  return right;
}

Linearisation::Step Linearisation::step(const Handed& start, const Handed& end,
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
    result.z[i] += zByPeriod_[i] * x[n] + zByFriction_[i] * x[n + 1];
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
    // The vector of a shift in time is the velocity of the motion.
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

Orbit Linearisation::changed(const Orbit& orbit, const Handed& end, const Step& step,
                             double factor) const {
  Orbit result = along(orbit, step.direction, factor);
  auto& z = result.start.z;
  std::vector<unsigned char> sticks(z.size());
  for (const PetscInt row : monodromy_.stuck) sticks[row] = 1;
  // A z that does not stick is that of the end of the period.
  for (std::size_t i = 0; i < z.size(); ++i)
    if (!sticks[i]) z[i] += factor * (end.z[i] - z[i] + step.z[i]);
  for (std::size_t i = 0; i < step.stuck.size(); ++i)
    z[monodromy_.stuck[i]] += factor * step.stuck[i];
  return result;
}

Found shoot(Period& period, const Orbit& guess, double tolerance, const Told& told,
            const Direction& tangent, std::shared_ptr<const Linearisation> linearisation) {
  Found found;
  found.orbit = guess;
  Passage passage = period.pass(found.orbit);
  found.change = cycles::change(period.model(), found.orbit.start, passage.end);
  bool fresh = false;
  const auto tell = [&] {
    if (told) told({found.change, found.derivatives});
  };
  const auto renew = [&] {
    tell();
    linearisation = std::make_shared<const Linearisation>(period, found.orbit);
    ++found.derivatives;
    fresh = true;
  };
  while (found.change > tolerance) {
    if (!linearisation) renew();
    const auto step = linearisation->step(found.orbit.start, passage.end, tangent);
    bool better = false;
    double factor = 1;
    for (; factor >= (fresh ? smallestStep : 1); factor /= 2) {
      const Orbit trial = linearisation->changed(found.orbit, passage.end, step, factor);
      if (!(trial.period > 0 && trial.friction > 0)) continue;
      try {
        Passage there = period.pass(trial);
        const double change = cycles::change(period.model(), trial.start, there.end);
        better = change < (1 - factor / 10) * found.change;
        if (!better) continue;
        // A linearisation that is used again must be worth it.
        const bool slow = change > found.change / 4;
        found.orbit = trial, found.change = change, passage = std::move(there);
        if (slow) fresh = false, linearisation.reset();
        break;
      } catch (const Error&) {  // a motion without bound
      }
    }
    if (better) {
      fresh = false;
      tell();
      if (linearisation || found.derivatives < mostLinearisations) continue;
      break;
    }
    if (fresh || found.derivatives >= mostLinearisations) break;
    linearisation.reset();
  }
  found.measures = passage.measures;
  found.converged = found.change <= tolerance;
  if (found.converged) renew(), found.linearisation = linearisation;
  return found;
}

}  // namespace squeal::cycles
