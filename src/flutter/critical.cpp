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
  Root(Family& family, const Event& event, double tolerance)
      : family_(family), event_(event), tolerance_(tolerance), real_(real(event.below[0].s) && real(event.above[0].s)) {}

  /// In the basis in force, which has `changed` since the last time.
  void locate(bool changed) {
    if (event_.low == event_.high) {  // at an end of a step, where equal eigenvalues part
      friction_ = event_.low;
      settled_ = true;
      return;
    }
    if (known_.empty() && (!addEnd(event_.low, event_.below) || !addEnd(event_.high, event_.above))) {
      settled_ = true;
      return;
    }
    const double before = friction_;
    friction_ = std::isnan(before) ? between(event_.low, known_[0].value, event_.high, known_[1].value, roughly()) : again(before);
    moved_ = std::isnan(before) ? roughly() : changed ? std::abs(friction_ - before) : 0;
    settled_ = std::isnan(friction_) || (!std::isnan(before) && moved_ <= tolerance_ * friction_);
  }
  bool settled() const { return settled_; }

  /// Where two eigenvalues are one, so is their vector.
  Located located() const {
    std::vector<DensePair> pairs = nearest(friction_).pairs();
    const Complex s = mean(pairs);
    pairs.resize(1);
    pairs[0].s = s;
    return {friction_, pairs};
  }
  void setBackwardError(double error) { backwardError_ = error; }

  Critical result() {
    Critical result{event_.kind, event_.branch, event_.partner, friction_, 0, 0, event_.loss, 0, backwardError_, true};
    if (event_.low == event_.high) {
      result.angularFrequency = mean(event_.below).imag();
    } else if (std::isnan(friction_)) {
      result.converged = false;
      result.friction = 0.5 * (event_.low + event_.high);
      result.errorEstimate = 0.5 * (event_.high - event_.low);
      result.angularFrequency = 0.5 * (mean(event_.below) + mean(event_.above)).imag();
    } else {
      result.converged = moved_ <= tolerance_ * friction_;
      result.errorEstimate = moved_ + rootTolerance();
      result.angularFrequency = mean(nearest(friction_).pairs()).imag();
      result.slope = slope_;
    }
    return result;
  }

 private:
  struct Sample {
    double friction, value;
    Spectrum spectrum;
    const std::vector<DensePair>& pairs() const { return spectrum.pairs(); }
  };

  bool addEnd(double friction, const std::vector<DensePair>& pairs) {
    const auto problem = family_.at(friction);
    if (!problem) return false;
    Spectrum spectrum(*problem, pairs);
    known_.push_back({friction, measure(spectrum), std::move(spectrum)});
    return true;
  }

  double measure(const Spectrum& spectrum) const {
    const auto& pairs = spectrum.pairs();
    switch (event_.kind) {
      case Event::Kind::coalescence:
        return discriminant(pairs, spectrum.damped());
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
    return (1 - t) * mean(below->pairs()) + t * mean(above->pairs());
  }

  double value(double friction) {
    auto found = pursued(family_, friction, nearest(friction).spectrum, expected(friction), event_.isolation);
    if (!found) return NAN;
    known_.push_back({friction, measure(*found), std::move(*found)});
    return known_.back().value;
  }

  double rootTolerance() const { return 1e-13 * std::max(std::abs(event_.high), std::abs(event_.low)); }

  double width() const { return event_.high - event_.low; }
  /// Good enough for a basis that is still to be improved.
  double roughly() const { return 1e-7 * width(); }

  double between(double a, double fa, double b, double fb, double tolerance) {
    return rootBetween(a, fa, b, fb, tolerance, [&](double f) { return value(f); });
  }

  /// The same root in the basis in force: it has moved little.
  double again(double before) {
    known_.erase(known_.begin() + 2, known_.end());
    const double reach = std::clamp(10 * moved_, 1e-6 * width(), 1e-3 * width());
    const double a = std::max(event_.low, before - reach), b = std::min(event_.high, before + reach);
    const double fa = value(a), fb = value(b);
    if (std::isnan(fa) || std::isnan(fb)) return NAN;
    slope_ = (event_.kind == Event::Kind::coalescence ? -1 : 1) * (fb - fa) / (b - a);
    if ((fa > 0) != (fb > 0)) return between(a, fa, b, fb, rootTolerance());
    return between(event_.low, known_[0].value, event_.high, known_[1].value, rootTolerance());
  }

  Family& family_;
  const Event& event_;
  double tolerance_, friction_ = NAN, moved_ = 0, backwardError_ = 0, slope_ = 0;
  bool settled_ = false;
  bool real_;                  // divergence of a real eigenvalue, in a damped problem
  std::vector<Sample> known_;  // the two ends first
};

}  // namespace

std::vector<Critical> criticalFrictions(Family& family, const Branches& branches, double tolerance) {
  constexpr int rounds = 10;
  std::vector<Root> roots;
  for (const auto& event : branches.events) {
    roots.emplace_back(family, event, tolerance);
    roots.back().locate(true);
  }
  for (int round = 0; round < rounds; ++round) {
    std::vector<Root*> open;
    std::vector<Located> located;
    for (auto& root : roots)
      if (!root.settled()) {
        open.push_back(&root);
        located.push_back(root.located());
      }
    if (open.empty()) break;
    const Improvement improvement = family.improve(located);
    for (std::size_t k = 0; k < improvement.backwardError.size(); ++k) open[k]->setBackwardError(improvement.backwardError[k]);
    for (auto* root : open) root->locate(improvement.changed);
    if (!improvement.changed) break;
  }
  std::vector<Critical> list;
  for (auto& root : roots) list.push_back(root.result());
  std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.friction < b.friction; });
  return list;
}

}  // namespace squeal::flutter
