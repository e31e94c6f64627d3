// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/tracking/neutral_end.hpp"

#include <cmath>

#include "base/system/mpi.hpp"
#include "eigen/tracking/growth.hpp"
#include "eigen/tracking/join.hpp"

namespace squeal::tracking {
namespace {

Complex low(const NeutralStep& step) { return step.event.below[0].s; }
Complex high(const NeutralStep& step) { return step.event.above[0].s; }
bool isNeutralBelow(const NeutralStep& step) { return neutral(low(step), true); }

/// Returns the sign of the growth rate near the neutral end; 0 if the slope does not show it.
int signNear(const NeutralStep& step) {
  constexpr double significant = 1e-9;  // of |s|, ten times as much as for neutral eigenvalues
  const double width = step.event.high - step.event.low,
               change = width * (isNeutralBelow(step) ? step.slopeBelow : -step.slopeAbove);
  return std::abs(change) <= significant * std::abs(low(step)) ? 0 : change > 0 ? 1 : -1;
}

int signFar(const NeutralStep& step) {
  return sign(isNeutralBelow(step) ? high(step) : low(step), true);
}

}  // namespace

bool changesSignWithin(const NeutralStep& step) {
  if (isNeutralBelow(step) == neutral(high(step), true)) return false;
  if (real(low(step)) || real(high(step))) return false;
  return signNear(step) != 0 && signNear(step) != signFar(step);
}

std::optional<std::vector<Event>> changesOf(const NeutralStep& step) {
  const bool atLow = isNeutralBelow(step);
  const int near = signNear(step);
  Event change = step.event;
  change.kind = Event::Kind::crossing;
  change.loss = atLow ? near < 0 : near > 0;
  const double width = change.high - change.low, end = atLow ? change.low : change.high;
  // Close to the neutral end the sign is certain, but the growth rate is small.
  for (double part = 0.25; part > 1e-4; part *= 0.25) {
    const double inside = atLow ? end + part * width : end - part * width;
    const auto found = step.pairAt(inside);
    if (found.size() != 1 || sign(found[0].s, true) != near) continue;
    std::vector<Event> events;
    (atLow ? change.low : change.high) = inside;
    (atLow ? change.below : change.above) = found;
    if (near > 0) {
      Event there = step.event;
      there.kind = Event::Kind::crossing;
      there.loss = atLow;
      there.low = there.high = end;
      (atLow ? there.above : there.below) = atLow ? there.below : there.above;
      events.push_back(std::move(there));
    }
    events.push_back(std::move(change));
    return events;
  }
  return {};
}

std::vector<Complex> slopes(MPI_Comm comm, const linalg::Spectrum& spectrum, const StepEnd& low,
                            const StepEnd& high) {
  const auto& pairs = spectrum.pairs();
  const auto change = [&](const linalg::DenseMatrix& a, const linalg::DenseMatrix& b) {
    linalg::DenseMatrix difference = b;
    linalg::addScaled(difference, -1, a);
    return linalg::timesVectors(difference, pairs);
  };
  const auto stiffness = change(low.problem.stiffness, high.problem.stiffness),
             damping = change(low.problem.damping, high.problem.damping),
             mass = change(low.problem.mass, high.problem.mass);
  std::vector<Complex> list;
  for (std::size_t j = 0; j < pairs.size(); ++j) {
    const auto& [s, x, y] = pairs[j];
    Complex sum = 0;
    for (std::size_t i = 0; i < y.size(); ++i)
      sum += std::conj(y[i]) * (stiffness(i, j) + s * damping(i, j) + s * s * mass(i, j));
    list.push_back(-sum / (high.friction - low.friction) / spectrum.derivative(j));
  }
  mpi::broadcast(comm, list);  // the ranks may differ in round-off, and decide by these values
  return list;
}

}  // namespace squeal::tracking
