// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/tracking/pair_tracer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "base/system/text.hpp"
#include "eigen/tracking/growth.hpp"
#include "eigen/tracking/join.hpp"
#include "eigen/tracking/neutral_end.hpp"
#include "eigen/tracking/step.hpp"

namespace squeal::tracking {
namespace {

constexpr double least = 1. / 65536;  // of `smallest`, to look for a change of stability

double width(const TraceRequest& request) { return request.high.friction - request.low.friction; }

bool isDamped(const TraceRequest& request) {
  return damped(request.low.spectrum, request.high.spectrum);
}

/// Returns true if the eigenvalues have different stability at both ends.
bool changesStability(const TraceRequest& request) {
  const bool damped = isDamped(request);
  return unstable(request.low.pairs(), damped) != unstable(request.high.pairs(), damped);
}

/// Returns true if each eigenvalue shares nearly its whole subspace with its mate, and little with
/// the other.
bool isClear(const TraceRequest& request, const std::vector<std::size_t>& mate) {
  const linalg::Spectrum &low = request.low.spectrum, &high = request.high.spectrum;
  bool clear = true;
  for (std::size_t i = 0; i < 2; ++i) {
    clear = clear && std::abs(low.overlap(i, high, mate[i]) - 1.0) < 0.25;
    clear = clear && std::abs(low.overlap(i, high, mate[1 - i])) < 0.25;
  }
  return clear;
}

}  // namespace

/// A search from an end where two eigenvalues are equal.
struct PairTracer::Approach {
  bool isLost = false;            // they are not found in between
  std::optional<PairAt> between;  // a friction before they split; none: they split at the end
};

std::optional<Trace> PairTracer::trace(const TraceRequest& request) const {
  const auto& [low, high, ids, isolation, smallest] = request;
  const auto &a = low.pairs(), &b = high.pairs();
  if (coincide(a) || coincide(b)) return traceFromEqual(request);
  const bool damped = isDamped(request);
  const bool merging = neutralPair(a, damped) && splitPair(b, damped),
             parting = splitPair(a, damped) && neutralPair(b, damped);
  if (merging || parting) return coalesced(request, merging);
  auto mate = assigned(low.spectrum, high.spectrum, {{0, 1}, {0, 1}, 0});
  const bool clear = isClear(request, mate);
  // A change of stability is searched on still smaller steps.
  if (clear || width(request) < (changesStability(request) ? least * smallest : smallest))
    return separate(request, std::move(mate), clear);
  const double middle = 0.5 * (low.friction + high.friction);
  auto found = continuedTo(family_, middle, low.spectrum, 0.5 * (mean(a) + mean(b)), isolation);
  if (!found) return {};
  return traceBy({middle, std::move(*found)}, request);
}

/// Returns the continuation of neutral eigenvalues that merge, or of a growing and a decaying one
/// that become neutral.
Trace PairTracer::coalesced(const TraceRequest& request, bool merging) const {
  const auto& [low, high, ids, isolation, smallest] = request;
  const auto &a = low.pairs(), &b = high.pairs();
  Trace trace{.mate = ordered(a, b)};
  const auto& split = merging ? b : a;
  const auto& whole = merging ? a : b;
  const std::size_t grown = split[0].s.real() > 0 ? 0 : 1,
                    grownLow = merging ? (trace.mate[0] == grown ? 0 : 1) : grown;
  // Where two neutral eigenvalues merge, the growing one loses its stability. Where two real ones
  // merge, the decaying one regains it.
  const bool divergent = real(whole[0].s);
  const std::size_t own = divergent ? 1 - grownLow : grownLow;
  trace.events.push_back({.kind = Event::Kind::coalescence,
                          .branch = ids[own],
                          .partner = ids[1 - own],
                          .loss = merging != divergent,
                          .low = low.friction,
                          .high = high.friction,
                          .below = a,
                          .above = b,
                          .isolation = isolation});
  return trace;
}

/// Returns the continuation of eigenvalues that do not meet in the step; if they are not clearly
/// distinct, a gap records their uncertain identity.
Trace PairTracer::separate(const TraceRequest& request, std::vector<std::size_t> mate,
                           bool clear) const {
  const auto& [low, high, ids, isolation, smallest] = request;
  const auto &a = low.pairs(), &b = high.pairs();
  const bool damped = isDamped(request);
  Trace trace{.mate = std::move(mate)};
  for (std::size_t i = 0; i < 2 && (clear || changesStability(request)); ++i) {
    const auto& end = b[trace.mate[i]];  // the number of changes does not depend on the identity
    Event step{.branch = ids[i],
               .low = low.friction,
               .high = high.friction,
               .below = {a[i]},
               .above = {end},
               .isolation = std::min(isolation, 2 * std::abs(a[0].s - mean(a)))};
    if (clear && damped && appendChanges(step, trace)) continue;
    if (auto event = crossing(std::move(step), sign(a[i].s, damped), sign(end.s, damped)))
      trace.events.push_back(std::move(*event));
  }
  if (!clear)
    trace.gaps.push_back({low.friction, high.friction,
                          formatted("two eigenvalues near %.6g Hz are too close to distinguish: "
                                    "both exist, but their identity is uncertain",
                                    mean(a).imag() / (2 * M_PI)),
                          true});
  return trace;
}

/// Collective. Returns true if the signs at both ends of a step do not show the changes of
/// stability of an eigenvalue that is neutral at one of them, and appends these changes.
bool PairTracer::appendChanges(const Event& event, Trace& trace) const {
  if (neutral(event.below[0].s, true) == neutral(event.above[0].s, true)) return false;
  const auto below = family_.at(event.low), above = family_.at(event.high);
  if (!below || !above) return false;
  const StepEnd low{event.low, *below}, high{event.high, *above};
  const linalg::Spectrum from(*below, event.below), to(*above, event.above);
  const auto slopeOf = [&](const linalg::Spectrum& spectrum) {
    return slopes(family_.comm(), spectrum, low, high)[0].real();
  };
  const NeutralStep step{event, slopeOf(from), slopeOf(to), [&](double friction) {
                           const double part = (friction - event.low) / (event.high - event.low);
                           const auto found =
                               continuedTo(family_, friction, part < 0.5 ? from : to,
                                           (1 - part) * event.below[0].s + part * event.above[0].s,
                                           event.isolation);
                           return found ? found->pairs() : std::vector<linalg::DensePair>();
                         }};
  if (!changesSignWithin(step)) return false;
  auto found = changesOf(step);
  if (!found) {
    trace.gaps.push_back(notExamined(event.low, event.high, event.below));
    return false;
  }
  std::ranges::move(*found, std::back_inserter(trace.events));
  return true;
}

/// Traces two eigenvalues via a friction in between.
std::optional<Trace> PairTracer::traceBy(const PairAt& between, const TraceRequest& request) const {
  const auto& [low, high, ids, isolation, smallest] = request;
  auto first = trace({low, between, ids, isolation, smallest});
  if (!first) return {};
  std::vector<int> idsBetween(2);
  for (std::size_t i = 0; i < 2; ++i) idsBetween[first->mate[i]] = ids[i];
  const auto second = trace({between, high, idsBetween, isolation, smallest});
  if (!second) return {};
  first->mate = {second->mate[first->mate[0]], second->mate[first->mate[1]]};
  first->events.insert(first->events.end(), second->events.begin(), second->events.end());
  first->gaps.insert(first->gaps.end(), second->gaps.begin(), second->gaps.end());
  return first;
}

/// Returns the two eigenvalues at the fraction `part` of the path from `equal` to `apart`.
std::optional<PairAt> PairTracer::within(const PairAt& equal, const PairAt& apart, double part,
                                         double isolation) const {
  const double friction = equal.friction + part * (apart.friction - equal.friction);
  const Complex expected = (1 - part) * mean(equal.pairs()) + part * mean(apart.pairs());
  auto found = continuedTo(family_, friction, apart.spectrum, expected, isolation);
  if (!found) return {};
  return PairAt{friction, std::move(*found)};
}

/// Finds whether two equal eigenvalues split immediately into those at `apart`.
PairTracer::Approach PairTracer::approach(const PairAt& equal, const PairAt& apart,
                                          const TraceRequest& request) const {
  const bool damped = isDamped(request);
  Approach way;
  PairAt last = apart;
  while (!way.between && std::abs(last.friction - equal.friction) > request.smallest) {
    auto found = within(equal, last, closer, request.isolation);
    if (!found) return {.isLost = true, .between = {}};
    if (coincide(found->pairs())) break;
    // In a problem in s² the growth may be too small to be recognised here.
    if (damped ? unstable(found->pairs(), true) != unstable(apart.pairs(), true)
               : discriminant(found->pairs(), false) > 0)
      way.between = found;
    last = std::move(*found);
  }
  return way;
}

/// Does the same as trace() for two eigenvalues that are equal at an end. If one changes its
/// stability, the step is cut ever closer to that end, since the change may be anywhere near it.
std::optional<Trace> PairTracer::traceFromEqual(const TraceRequest& request) const {
  const auto& [low, high, ids, isolation, smallest] = request;
  const auto &a = low.pairs(), &b = high.pairs();
  const bool damped = isDamped(request), equalBelow = coincide(a),
             equalTwice = equalBelow && coincide(b);
  Trace trace{.mate = ordered(a, b)};
  std::array<int, 2> before{}, after{};
  for (std::size_t k = 0; k < 2; ++k) {
    before[k] = growthOf(a, k, damped);
    after[k] = growthOf(b, trace.mate[k], damped);
  }
  if (!changes(before[0], after[0]) && !changes(before[1], after[1])) return trace;
  const PairAt &equal = equalBelow ? low : high, &apart = equalBelow ? high : low;
  if (!equalTwice && meetingPoint(mean(equal.pairs()), damped) &&
      (damped || splitPair(apart.pairs(), damped))) {
    const Approach way = approach(equal, apart, request);
    if (way.isLost) return {};
    if (way.between) return traceBy(*way.between, request);
    for (std::size_t k = 0; k < 2; ++k)
      if (changes(before[k], after[k]))
        trace.events.push_back(splitting({.branch = ids[k],
                                          .low = low.friction,
                                          .high = high.friction,
                                          .below = {a[k]},
                                          .above = {b[trace.mate[k]]}},
                                         after[k] > before[k], equalBelow));
    return trace;
  }
  const bool last = width(request) < least * smallest;
  if (!last) {
    const auto found = within(equal, apart, equalTwice ? 0.5 : closer, isolation);
    if (!found) return {};
    if (!equalTwice || !coincide(found->pairs())) return traceBy(*found, request);
  }
  const bool together = equalTwice && !last;
  for (std::size_t k = 0; k < 2; ++k) {
    const double distance =
        together ? isolation : std::abs(apart.pairs()[0].s - apart.pairs()[1].s);
    if (auto event = crossing({.branch = ids[k],
                               .low = low.friction,
                               .high = high.friction,
                               .below = together ? a : chosen(a, {k}),
                               .above = together ? b : chosen(b, {trace.mate[k]}),
                               .isolation = distance},
                              before[k], after[k]))
      trace.events.push_back(std::move(*event));
  }
  return trace;
}

}  // namespace squeal::tracking
