// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/tracking/neutral_end.hpp"

#include <algorithm>
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

/// An eigenvalue of a branch at a station.
struct Sample {
  double friction;
  Complex s;
};

/// Returns the eigenvalues of the branch of an event at the stations of its piece, by ascending
/// friction, and that at the neutral end where the event is.
std::vector<Sample> samplesOf(const Event& event, const std::vector<Station>& stations) {
  std::vector<Sample> samples{{event.low, event.below[0].s}};
  for (const auto& station : stations) {
    if (station.piece != event.piece || station.friction == event.low) continue;
    for (std::size_t j = 0; j < station.pairs.size(); ++j)
      if (station.branch[j] == event.branch)
        samples.push_back({station.friction, station.pairs[j].s});
  }
  std::ranges::sort(samples, {}, &Sample::friction);
  return samples;
}

/// Returns the sign of Re s; 0 within round-off.
int certainSign(Complex s) {
  constexpr double roundOff = 1e-13;
  return std::abs(s.real()) <= roundOff * std::abs(s) ? 0 : s.real() > 0 ? 1 : -1;
}

/// The samples around a neutral end, and the two between which the eigenvalue changes its
/// stability; the same one twice if the change is there.
struct Search {
  std::vector<Sample> samples;
  std::ptrdiff_t low = 0, high = 0;
  /// The eigenvalue grows from the neutral end to this sample, and does not count as neutral here.
  bool growsOn = false;
};

/// Searches from the neutral end of an event away from growth.
Search searchFrom(const Event& event, const std::vector<Station>& stations) {
  Search search{.samples = samplesOf(event, stations)};
  const auto& samples = search.samples;
  const auto place = std::ranges::find(samples, event.low, &Sample::friction);
  const std::ptrdiff_t at = place - samples.begin(), away = event.loss ? -1 : 1;
  const auto has = [&](std::ptrdiff_t k) { return k >= 0 && k < std::ssize(samples); };
  const auto between = [&](std::ptrdiff_t one, std::ptrdiff_t other) {
    search.low = std::min(one, other);
    search.high = std::max(one, other);
    return search;
  };
  const int here = certainSign(samples[at].s);
  if (here == 0) return between(at, at);
  if (here < 0) {
    const bool grows = has(at - away) && certainSign(samples[at - away].s) > 0;
    return between(at, grows ? at - away : at);
  }
  for (std::ptrdiff_t k = at; has(k + away); k += away) {
    const Complex s = samples[k + away].s;
    const int sign = certainSign(s);
    if (sign == 0) return between(k + away, k + away);
    if (sign < 0) return between(k, k + away);
    search.growsOn = !neutral(s, true);
    if (search.growsOn) return between(k + away, k + away);
  }
  return between(at, at);  // the samples end: nothing is known beyond
}

bool isAtNeutralEnd(const Event& event) {
  return event.kind == Event::Kind::crossing && event.low == event.high &&
         event.below.size() == 1 && neutral(event.below[0].s, true);
}

/// Returns true if the branch grows from this event on to a neutral end with the opposite change.
bool isUndone(const Event& event, const Search& search, const std::vector<Event>& events) {
  if (!search.growsOn) return false;
  const auto [low, high] = std::minmax(event.low, search.samples[search.low].friction);
  return std::ranges::any_of(events, [low = low, high = high, &event](const Event& other) {
    return isAtNeutralEnd(other) && other.branch == event.branch && other.piece == event.piece &&
           other.loss != event.loss && other.low >= low && other.low <= high;
  });
}

/// Collective. Returns the pair of an event with one eigenvalue, continued from its neutral end to
/// a sample; none if it is not found there.
std::vector<linalg::DensePair> pairsAt(Family& family, const Event& event, const Sample& sample) {
  if (sample.friction == event.low) return event.below;
  const auto problem = family.at(event.low);
  if (!problem) return {};
  const auto found =
      continuedTo(family, sample.friction, {*problem, event.below}, sample.s, event.isolation);
  return found ? found->pairs() : std::vector<linalg::DensePair>();
}

}  // namespace

void bracketNeutralEnds(const std::vector<Piece>& path, Branches& branches) {
  std::vector<Event> events;
  for (const auto& event : branches.events) {
    events.push_back(event);
    if (!isAtNeutralEnd(event)) continue;
    const Search search = searchFrom(event, branches.stations);
    if (isUndone(event, search, branches.events)) events.pop_back();
    if (search.growsOn) continue;
    const Sample &low = search.samples[search.low], &high = search.samples[search.high];
    Family& family = *path[event.piece].family;
    auto below = pairsAt(family, event, low), above = pairsAt(family, event, high);
    if (below.empty() || above.empty()) continue;
    Event& moved = events.back();
    moved.low = low.friction;
    moved.high = high.friction;
    moved.below = std::move(below);
    moved.above = std::move(above);
  }
  branches.events = std::move(events);
}

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
