// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/stability/critical_root.hpp"

#include <algorithm>
#include <optional>

#include "eigen/stability/bracketed_root.hpp"

namespace squeal::stability {

using tracking::continuedIn;
using tracking::discriminant;
using tracking::mean;
using tracking::PairsAtFriction;
using tracking::real;

void CriticalRoot::locate(Family& family, bool changed) {
  const double before = friction_;
  // Equal eigenvalues split at an end of a step, and eigenvalues jump between two pieces of a path.
  if (jumps()) return locateJump(family, changed);
  if (event_.low == event_.high || event_.kind == Event::Kind::contact) {
    friction_ = 0.5 * (event_.low + event_.high);
    settled_ = true;
    return;
  }
  const bool first = known_.empty();
  friction_ = first ? searchFromEnds(family) : refined(family);
  moved_ = first ? roughly() : changed ? std::abs(friction_ - before) : 0;
  settled_ = std::isnan(friction_) || (!first && moved_ <= tolerance_ * friction_);
}

/// Finds the eigenvalue after a jump in the present basis. It is settled when it no longer moves.
void CriticalRoot::locateJump(Family& family, bool changed) {
  const bool first = known_.empty();
  friction_ = event_.high;
  settled_ = true;
  const auto problem = lost_ || !(first || changed) ? std::nullopt : family.near(friction_);
  if (!problem) return;
  if (first) {
    known_.push_back({friction_, 0, linalg::Spectrum(*problem, event_.above)});
    settled_ = false;
    return;
  }
  auto& spectrum = known_.front().spectrum;
  const Complex before = mean(spectrum.pairs());
  auto found = continuedIn(*problem, spectrum, before, event_.isolation);
  if (!found) return;
  settled_ = std::abs(mean(found->pairs()) - before) <= tolerance_ * std::abs(before);
  spectrum = std::move(*found);
}

PairsAtFriction CriticalRoot::located() const {
  std::vector<linalg::DensePair> pairs = nearest(friction_).pairs();
  const Complex s = mean(pairs);
  pairs.resize(1);
  pairs[0].s = s;
  return {friction_, pairs};
}

void CriticalRoot::setErrors(double backwardError, double roundOff) {
  lost_ = std::isnan(backwardError);
  if (lost_) return;
  backwardError_ = backwardError;
  roundOff_ = roundOff;
}

Critical CriticalRoot::result() const {
  Critical result{.kind = event_.kind,
                  .branch = event_.branch,
                  .partner = event_.partner,
                  .friction = friction_,
                  .loss = event_.loss,
                  .backwardError = backwardError_,
                  .piece = event_.piece};
  if (event_.low == event_.high || event_.kind == Event::Kind::contact) {
    result.angularFrequency =
        mean(known_.empty() ? event_.above : nearest(friction_).pairs()).imag();
    result.errorEstimate = 0.5 * (event_.high - event_.low);
    result.converged = event_.low == event_.high;
  } else if (std::isnan(friction_)) {
    result.converged = false;
    result.friction = 0.5 * (event_.low + event_.high);
    result.errorEstimate = 0.5 * (event_.high - event_.low);
    result.angularFrequency = 0.5 * (mean(event_.below) + mean(event_.above)).imag();
  } else {
    result.converged = !lost_ && moved_ <= tolerance_ * friction_ &&
                       rootTolerance() <= std::max(tolerance_ * friction_, 1e-12);
    result.errorEstimate = moved_ + rootTolerance() + roundOffError();
    result.angularFrequency = mean(nearest(friction_).pairs()).imag();
    result.slope = event_.kind == Event::Kind::coalescence ? -slope_ : slope_;
  }
  return result;
}

double CriticalRoot::measure(const linalg::Spectrum& spectrum) const {
  const auto& pairs = spectrum.pairs();
  switch (event_.kind) {
    case Event::Kind::coalescence:
      return discriminant(pairs, spectrum.damped());
    case Event::Kind::divergence:
      return throughZero_ && spectrum.damped() ? mean(pairs).real()
                                               : (mean(pairs) * mean(pairs)).real();
    case Event::Kind::crossing:
      return mean(pairs).real();  // of two equal eigenvalues that cross together
    case Event::Kind::contact:
      break;  // it jumps
  }
  return NAN;
}

const CriticalRoot::Sample& CriticalRoot::nearest(double friction) const {
  return *std::min_element(known_.begin(), known_.end(), [&](const Sample& a, const Sample& b) {
    return std::abs(a.friction - friction) < std::abs(b.friction - friction);
  });
}

/// Returns the mean of the eigenvalues, interpolated between the nearest samples on both sides.
Complex CriticalRoot::expected(double friction) const {
  const Sample *below = &known_[0], *above = &known_[1];
  for (const auto& sample : known_) {
    if (sample.friction <= friction && sample.friction > below->friction) below = &sample;
    if (sample.friction >= friction && sample.friction < above->friction) above = &sample;
  }
  const double width = above->friction - below->friction,
               t = width > 0 ? (friction - below->friction) / width : 0;
  return (1 - t) * mean(below->pairs()) + t * mean(above->pairs());
}

/// Returns the function at a friction and stores a sample. The value is NaN if there is no problem
/// at this friction or its eigenvalues are not found. It is zero, without a sample, if two
/// eigenvalues are too close to distinguish.
double CriticalRoot::valueAt(Family& family, double friction) {
  if (reach(family, friction)) return known_.back().value;
  const bool met = event_.kind == Event::Kind::coalescence &&
                   std::abs(friction - nearest(friction).friction) <= 1e-9 * width();
  return met && family.near(friction) ? 0 : NAN;
}

/// Returns the samples to continue from, the best first. For two eigenvalues that meet, the best
/// side is the one where they have split into a growing and a decaying one: on the other side a
/// third eigenvalue may pass and exchange its vector with one of them.
std::vector<const CriticalRoot::Sample*> CriticalRoot::starts(double friction) const {
  const Sample *split = nullptr, *closest = &nearest(friction);
  for (const auto& sample : known_)
    if (event_.kind == Event::Kind::coalescence && sample.value < 0 &&
        (!split || std::abs(sample.friction - friction) < std::abs(split->friction - friction)))
      split = &sample;
  if (!split || split == closest) return {closest};
  return {split, closest};
}

/// Appends a sample at a friction by continuation from an existing one. If the subspace rotates too
/// much on the way, it takes smaller steps. Returns false if that fails, or if there is no problem
/// on the way.
bool CriticalRoot::reach(Family& family, double friction) {
  constexpr int most = 24;  // attempts
  double next = friction;
  for (int attempt = 0; attempt < most; ++attempt) {
    const auto problem = family.near(next);
    if (!problem) return false;
    std::optional<linalg::Spectrum> found;
    for (const Sample* start : starts(next)) {
      found = continuedIn(*problem, start->spectrum, expected(next), event_.isolation);
      if (found) break;
    }
    if (!found) {
      next = 0.5 * (nearest(next).friction + next);
      continue;
    }
    known_.push_back({next, measure(*found), std::move(*found)});
    if (next == friction) return true;
    next = friction;
  }
  return false;
}

double CriticalRoot::rootTolerance() const {
  return 1e-13 * std::max(std::abs(event_.high), std::abs(event_.low));
}

/// Returns the shift of the root by round-off: the round-off of the function over its slope.
/// Towards a coalescence the half distance d of two eigenvalues becomes zero and the condition
/// number of each grows like 1/d, so the change 2 d δs of d² stays finite.
double CriticalRoot::roundOffError() const {
  if (!(std::abs(slope_) > 0)) return 0;
  const Sample& sample = nearest(friction_);
  double change = 0;  // of s
  for (std::size_t i = 0; i < sample.pairs().size(); ++i)
    change = std::max(change, roundOff_ / std::abs(sample.spectrum.derivative(i)));
  double perChange = 1;
  if (event_.kind == Event::Kind::coalescence) perChange = 2 * std::sqrt(std::abs(sample.value));
  if (event_.kind == Event::Kind::divergence && !(throughZero_ && sample.spectrum.damped()))
    perChange = 2 * std::abs(mean(sample.pairs()));
  const double error = perChange * change / std::abs(slope_);
  return std::isfinite(error) ? error : 0;
}

double CriticalRoot::searchFromEnds(Family& family) {
  for (const bool low : {true, false}) {
    const double friction = low ? event_.low : event_.high;
    const auto problem = family.near(friction);
    if (!problem) return NAN;
    linalg::Spectrum spectrum(*problem, low ? event_.below : event_.above);
    known_.push_back({friction, measure(spectrum), std::move(spectrum)});
  }
  return search(family, known_[0].value, known_[1].value, roughly());
}

/// Searches the whole bracket in the present basis. Returns NaN if the root has left the bracket.
/// If the function is unknown at an end of the bracket, for example because equal eigenvalues split
/// there, the value in the first basis applies.
double CriticalRoot::searchAgain(Family& family) {
  double low = valueAt(family, event_.low), high = valueAt(family, event_.high);
  if (std::isnan(low)) low = known_[0].value;
  if (std::isnan(high)) high = known_[1].value;
  return search(family, low, high, rootTolerance());
}

/// Returns NaN if the values at both ends of the bracket have the same sign.
double CriticalRoot::search(Family& family, double low, double high, double tolerance) {
  if (low == 0) return event_.low;
  if (high == 0) return event_.high;
  if ((low > 0) == (high > 0)) return NAN;
  BracketedRoot root({event_.low, low}, {event_.high, high}, tolerance);
  while (!root.done()) {
    const double value = valueAt(family, root.next());
    if (std::isnan(value)) return NAN;
    root.take(value);
  }
  return root.root();
}

/// Improves the root of the previous basis in the present one, by Newton's method with a fixed
/// slope, taken from two frictions 2e-5 of the bracket apart.
double CriticalRoot::refined(Family& family) {
  if (lost_) return NAN;
  const Sample start = nearest(friction_);
  known_.erase(known_.begin() + 2, known_.end());
  known_.push_back(start);
  const double left = std::max(event_.low, friction_ - 1e-5 * width());
  double at = std::min(event_.high, friction_ + 1e-5 * width()), last = INFINITY;
  if (!(left < at)) return searchAgain(family);  // the difference would be below round-off
  const double before = valueAt(family, left);
  double value = valueAt(family, at);
  slope_ = (value - before) / (at - left);
  for (int step = 1; std::isfinite(value) && std::isfinite(slope_); ++step) {
    const double change = -value / slope_, next = at + change;
    const bool inside = next >= event_.low && next <= event_.high,
               closer = step <= 2 || std::abs(change) < 0.1 * last;
    if (!inside || !closer) return searchAgain(family);
    last = std::abs(change);
    // A step has a relative error of about 1e-4.
    if (step > 1 && last <= 1e3 * rootTolerance()) return next;
    at = next;
    value = valueAt(family, at);
  }
  return NAN;
}

}  // namespace squeal::stability
