// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/tracking/step_joiner.hpp"

#include <algorithm>
#include <cmath>

#include "base/system/text.hpp"
#include "eigen/tracking/growth.hpp"

namespace squeal::tracking {

StepResult StepJoiner::join(const SolvedStation& a, const SolvedStation& b) const {
  const Ends ends{a, b, a.spectrum, b.spectrum};
  StepResult step;
  for (const auto& group : groups(ends.here, ends.there)) {
    if (group.joined() && group.here.size() == 1) {
      joinSingle(ends, group, step);
      continue;
    }
    std::optional<Trace> trace;
    if (group.joined() && lasts(ends, group)) trace = traced(ends, group);
    if (trace) {
      step.events.insert(step.events.end(), trace->events.begin(), trace->events.end());
      step.gaps.insert(step.gaps.end(), trace->gaps.begin(), trace->gaps.end());
      for (std::size_t k = 0; k < trace->mate.size(); ++k)
        step.links.push_back({group.here[k], group.there[trace->mate[k]], 1});
    } else {
      const bool counts = matters(ends, group);
      joinUncertain(ends, group, counts, step);
      step.sure = step.sure && !counts;
    }
  }
  return step;
}

StepResult StepJoiner::jump(Family& before, const SolvedStation& a, const SolvedStation& b) const {
  const auto here = before.shared(a.station.friction, a.station.pairs),
             there = family_.shared(b.station.friction, b.station.pairs);
  const Ends ends{a, b, here, there};
  StepResult step;
  for (const auto& group : groups(here, there))
    if (group.joined())
      joinAcrossJump(ends, group, step);
    else
      joinUncertain(ends, group, matters(ends, group), step);
  step.sure = step.gaps.empty();
  return step;
}

/// Returns true if a member is in the band at one end.
bool StepJoiner::matters(const Ends& ends, const Group& group) const {
  return std::ranges::any_of(group.here, [&](auto i) { return ends.a.station.inBand[i]; }) ||
         std::ranges::any_of(group.there, [&](auto j) { return ends.b.station.inBand[j]; });
}

/// Returns true if a member has a damping ratio within that of the band. Strongly damped
/// eigenvalues need not be distinguished.
bool StepJoiner::lasts(const Ends& ends, const Group& group) const {
  const auto one = [&](const SolvedStation& end, std::size_t i) {
    return band_.lasts(end.station.pairs[i].s);
  };
  return std::ranges::any_of(group.here, [&](auto i) { return one(ends.a, i); }) ||
         std::ranges::any_of(group.there, [&](auto j) { return one(ends.b, j); });
}

/// Returns the smallest distance of the mean of a group, at either end, from all other eigenvalues
/// and from zero.
double StepJoiner::isolation(const Ends& ends, const Group& group) const {
  double distance = INFINITY;
  const auto reach = [&](const std::vector<linalg::DensePair>& pairs,
                         const std::vector<std::size_t>& own) {
    const Complex middle = mean(chosen(pairs, own));
    distance = std::min(distance, std::abs(middle));
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (std::find(own.begin(), own.end(), i) == own.end())
        distance = std::min(distance, std::abs(pairs[i].s - middle));
  };
  reach(ends.a.spectrum.pairs(), group.here);
  reach(ends.b.spectrum.pairs(), group.there);
  return distance;
}

void StepJoiner::joinSingle(const Ends& ends, const Group& group, StepResult& step) const {
  const auto& [a, b, here, there] = ends;
  const std::size_t i = group.here[0], j = group.there[0];
  const int branch = i;  // until all earlier steps are finished
  step.links.push_back({i, j, std::abs(here.overlap(i, there, j))});
  if (!matters(ends, group)) return;
  const linalg::DensePair &p = here.pairs()[i], &q = there.pairs()[j];
  step.singles.push_back({branch, p, q, isolation(ends, group)});
  const bool damped = tracking::damped(here, there);
  if (auto event = crossing({.branch = branch,
                             .low = a.station.friction,
                             .high = b.station.friction,
                             .below = {p},
                             .above = {q},
                             .isolation = step.singles.back().isolation},
                            sign(p.s, damped), sign(q.s, damped)))
    step.events.push_back(std::move(*event));
}

/// Joins a group by its largest overlaps, without certainty, and appends a gap if it `counts`.
void StepJoiner::joinUncertain(const Ends& ends, const Group& group, bool counts,
                               StepResult& step) const {
  const auto& [a, b, here, there] = ends;
  const auto mate = assigned(here, there, group);
  for (std::size_t k = 0; k < mate.size(); ++k)
    if (mate[k] < group.there.size())
      step.links.push_back({group.here[k], group.there[mate[k]],
                            std::abs(here.overlap(group.here[k], there, group.there[mate[k]]))});
  if (!counts) return;
  const auto pairs = group.here.empty() ? chosen(b.spectrum.pairs(), group.there)
                                        : chosen(a.spectrum.pairs(), group.here);
  step.gaps.push_back(
      {a.station.friction, b.station.friction,
       formatted("uncertain match near %.6g Hz: eigenvalues at the start: %zu, at the end: %zu",
                 mean(pairs).imag() / (2 * M_PI), group.here.size(), group.there.size())});
}

/// Joins a group across a jump of the eigenvalues.
void StepJoiner::joinAcrossJump(const Ends& ends, const Group& group, StepResult& step) const {
  const auto& [a, b, here, there] = ends;
  const bool damped = tracking::damped(here, there);
  const auto from = chosen(here.pairs(), group.here), to = chosen(there.pairs(), group.there);
  const bool single = from.size() == 1;
  const auto mate = single ? std::vector<std::size_t>{0} : ordered(from, to);
  for (std::size_t k = 0; k < mate.size(); ++k) {
    const std::size_t i = group.here[k], j = group.there[mate[k]];
    step.links.push_back({i, j, single ? std::abs(here.overlap(i, there, j)) : 1});
    const int before = growthOf(from, k, damped), after = growthOf(to, mate[k], damped);
    if (changes(before, after) && matters(ends, group))
      step.events.push_back({.kind = Event::Kind::contact,
                             .branch = int(i),
                             .loss = after > before,
                             .low = a.station.friction,
                             .high = b.station.friction,
                             .below = {a.station.pairs[i]},
                             .above = {b.station.pairs[j]},
                             .isolation = isolation(ends, {{i}, {j}})});
  }
}

/// Traces several eigenvalues as a group. Returns none if their identification needs more frictions
/// in between.
std::optional<Trace> StepJoiner::traced(const Ends& ends, const Group& group) const {
  const auto& [a, b, spectrumHere, spectrumThere] = ends;
  const auto here = chosen(spectrumHere.pairs(), group.here),
             there = chosen(spectrumThere.pairs(), group.there);
  if (here.size() == 2) {
    const PairAt low{a.station.friction, linalg::Spectrum(a.problem, here)},
        high{b.station.friction, linalg::Spectrum(b.problem, there)};
    return PairTracer(family_).trace({.low = low,
                                      .high = high,
                                      .ids = {group.here.begin(), group.here.end()},
                                      .isolation = isolation(ends, group),
                                      .smallest = std::ldexp(high.friction - low.friction, -14)});
  }
  auto mate = ordered(here, there);
  if (!coincide(here) && !coincide(there)) return {};
  auto events = splittings(ends, group, mate);
  if (!events) return {};
  return Trace{.mate = std::move(mate), .events = std::move(*events)};
}

/// Returns the events of three or more eigenvalues that are equal at one end and change their
/// stability there. Returns none if they change it elsewhere.
std::optional<std::vector<Event>> StepJoiner::splittings(
    const Ends& ends, const Group& group, const std::vector<std::size_t>& mate) const {
  const auto& [a, b, spectrumHere, spectrumThere] = ends;
  const auto here = chosen(spectrumHere.pairs(), group.here),
             there = chosen(spectrumThere.pairs(), group.there);
  const bool damped = tracking::damped(spectrumHere, spectrumThere), equalBelow = coincide(here);
  const SolvedStation& apart = equalBelow ? b : a;
  const Complex s = mean(equalBelow ? here : there);
  const double equalAt = (equalBelow ? a : b).station.friction,
               near = equalAt + PairTracer::closer * (apart.station.friction - equalAt);
  std::vector<Event> events;
  for (std::size_t k = 0; k < here.size(); ++k) {
    const int before = growthOf(here, k, damped), after = growthOf(there, mate[k], damped);
    if (!changes(before, after)) continue;
    const auto& pair = equalBelow ? there[mate[k]] : here[k];
    const Complex way = PairTracer::closer * (pair.s - s);
    const auto found =
        continuedTo(family_, near, linalg::Spectrum(apart.problem, {pair}), s + way, std::abs(way));
    if (!meetingPoint(s, damped) || !found || found->pairs()[0].s.real() / way.real() < 0.1)
      return {};
    events.push_back(splitting({.branch = int(group.here[k]),
                                .low = a.station.friction,
                                .high = b.station.friction,
                                .below = {here[k]},
                                .above = {there[mate[k]]}},
                               after > before, equalBelow));
  }
  return events;
}

}  // namespace squeal::tracking
