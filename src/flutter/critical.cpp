#include "flutter/critical.hpp"

#include <algorithm>
#include <cmath>

#include "flutter/join.hpp"

namespace squeal::flutter {
namespace {

using Complex = std::complex<double>;

/// Root of a continuous function in a bracket to within `tolerance`, NaN if it is NaN somewhere (T. R. Chandrupatla, Advances in
/// Engineering Software 28 (1997) 145–149: inverse quadratic interpolation where it is safe, otherwise halving).
template <class Function>
double rootBetween(double a, double fa, double b, double fb, double tolerance, const Function& function) {
  double c = a, fc = fa, t = fa / (fa - fb);
  for (int k = 0; k < 100; ++k) {
    const double x = a + t * (b - a), fx = function(x);
    if (std::isnan(fx)) return NAN;
    if ((fx > 0) == (fa > 0)) {
      c = a, fc = fa;
    } else {
      c = b, fc = fb;
      b = a, fb = fa;
    }
    a = x, fa = fx;
    const double limit = tolerance / std::abs(b - a);
    if (fa == 0 || limit > 0.5) return std::abs(fa) < std::abs(fb) ? a : b;
    const double xi = (a - b) / (c - b), phi = (fa - fb) / (fc - fb);
    t = 0.5;
    if (phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi)
      t = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb);
    t = std::clamp(t, limit, 1 - limit);
  }
  return a;
}

class Root {
 public:
  Root(Family& family, const Event& event, double tolerance) : family_(family), event_(event), tolerance_(tolerance) {
    known_ = {{event.low, measure(event.below), event.below}, {event.high, measure(event.above), event.above}};
  }

  Critical solve() {
    Critical result;
    result.kind = event_.kind;
    result.branch = event_.branch;
    result.partner = event_.partner;
    result.loss = event_.loss;
    if (event_.low == event_.high) {  // at an end of a step, where equal eigenvalues part
      result.friction = event_.low;
      result.angularFrequency = mean(event_.below).imag();
      return result;
    }
    double friction = between(event_.low, known_[0].value, event_.high, known_[1].value);
    for (int round = 0; round < 10 && std::isfinite(friction); ++round) {
      const Improvement improvement = family_.improve(friction, concerned(friction));
      result.backwardError = improvement.backwardError;
      if (!improvement.changed) break;
      const double before = friction;
      friction = again(before);
      result.errorEstimate = std::abs(friction - before);
      if (result.errorEstimate <= tolerance_ * friction) break;
    }
    result.converged = std::isfinite(friction) && result.errorEstimate <= tolerance_ * friction;
    result.friction = std::isfinite(friction) ? friction : 0.5 * (event_.low + event_.high);
    result.errorEstimate = std::isfinite(friction) ? result.errorEstimate + rootTolerance() : 0.5 * (event_.high - event_.low);
    result.angularFrequency = mean(nearest(result.friction).pairs).imag();
    if (result.converged) result.slope = slope(friction);
    return result;
  }

 private:
  struct Sample {
    double friction, value;
    std::vector<DensePair> pairs;
  };

  double measure(const std::vector<DensePair>& pairs) const {
    switch (event_.kind) {
      case Event::Kind::coalescence:
        return discriminant(pairs);
      case Event::Kind::divergence:
        return (pairs[0].s * pairs[0].s).real();
      case Event::Kind::crossing:
        return pairs[0].s.real();
    }
    return NAN;
  }

  const Sample& nearest(double friction) const {
    return *std::min_element(known_.begin(), known_.end(), [&](const Sample& a, const Sample& b) {
      return std::abs(a.friction - friction) < std::abs(b.friction - friction);
    });
  }

  /// Mean of the eigenvalues between the nearest known frictions on both sides.
  Complex expected(double friction) const {
    const Sample *below = &known_[0], *above = &known_[1];
    for (const auto& sample : known_) {
      if (sample.friction <= friction && sample.friction > below->friction) below = &sample;
      if (sample.friction >= friction && sample.friction < above->friction) above = &sample;
    }
    const double width = above->friction - below->friction, t = width > 0 ? (friction - below->friction) / width : 0;
    return (1 - t) * mean(below->pairs) + t * mean(above->pairs);
  }

  double value(double friction) {
    const auto problem = family_.at(friction);
    if (!problem) return NAN;
    const Cluster cluster =
        clusterTogether(family_.comm(), *problem, nearest(friction).pairs, expected(friction), event_.isolation);
    if (!cluster.converged) return NAN;
    const double value = event_.kind == Event::Kind::coalescence ? cluster.discriminant : measure(cluster.pairs);
    known_.push_back({friction, value, cluster.pairs});
    return value;
  }

  double rootTolerance() const { return 1e-13 * std::max(std::abs(event_.high), std::abs(event_.low)); }

  double between(double a, double fa, double b, double fb) {
    return rootBetween(a, fa, b, fb, rootTolerance(), [&](double f) { return value(f); });
  }

  /// The same root in the grown basis: it has moved little.
  double again(double before) {
    const double reach = 1e-3 * (event_.high - event_.low);
    known_.resize(2);
    const double a = std::max(event_.low, before - reach), b = std::min(event_.high, before + reach);
    const double fa = value(a), fb = value(b);
    if (std::isnan(fa) || std::isnan(fb)) return NAN;
    if ((fa > 0) != (fb > 0)) return between(a, fa, b, fb);
    return between(event_.low, known_[0].value, event_.high, known_[1].value);
  }

  /// Where two eigenvalues are one, so is their vector.
  std::vector<DensePair> concerned(double friction) const {
    std::vector<DensePair> pairs = nearest(friction).pairs;
    const Complex s = mean(pairs);
    pairs.resize(1);
    pairs[0].s = s;
    return pairs;
  }

  /// By a central difference.
  double slope(double friction) {
    const double reach = 1e-4 * (event_.high - event_.low);
    const double low = std::max(friction - reach, event_.low), high = std::min(friction + reach, event_.high);
    return (event_.kind == Event::Kind::coalescence ? -1 : 1) * (value(high) - value(low)) / (high - low);
  }

  Family& family_;
  const Event& event_;
  double tolerance_;
  std::vector<Sample> known_;  // the two ends first
};

}  // namespace

std::vector<Critical> criticalFrictions(Family& family, const Branches& branches, double tolerance) {
  std::vector<Critical> list;
  for (const auto& event : branches.events) list.push_back(Root(family, event, tolerance).solve());
  std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.friction < b.friction; });
  return list;
}

}  // namespace squeal::flutter
