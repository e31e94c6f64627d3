// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/tracking/screen.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/linalg/rayleigh_ritz.hpp"
#include "eigen/tracking/join.hpp"
#include "eigen/tracking/step.hpp"

namespace squeal::tracking {
namespace {

/// The cubic with given values and slopes at 0 and 1.
struct Cubic {
  double value0, slope0, value1, slope1;
  double operator()(double t) const {
    const double u = 1 - t;
    return u * u * (1 + 2 * t) * value0 + t * t * (3 - 2 * t) * value1 +
           t * u * (u * slope0 - t * slope1);
  }
  /// Returns the place of the smallest value between 0 and 1, among 63 samples.
  double lowest() const {
    constexpr int samples = 64;
    double best = 0.5;
    for (int k = 1; k < samples; ++k) {
      const double t = 1.0 * k / samples;
      if ((*this)(t) < (*this)(best)) best = t;
    }
    return best;
  }
};

/// Decides whether a function over a step, t from 0 to 1, that is positive at both ends, becomes
/// negative in between.
class Dip {
 public:
  enum class Result { negative, positive, unknown };
  /// Takes the values at the ends; 1e-10 of the larger one counts as zero.
  Dip(double atLow, double atHigh)
      : atLow_(atLow), atHigh_(atHigh), nothing_(1e-10 * std::max(atLow, atHigh)) {}

  /// Searches from t by parabolas through three points, which move closer as the minimum approaches
  /// zero. `value(t)` is NaN if it is unknown. If the last parabola gives no decision, the result
  /// is unknown.
  template <class Function>
  Result search(double t, const Function& value) {
    constexpr int most = 6;
    double reach = 0.05;
    at_ = t;
    double middle = value(t);
    for (int k = 0;; ++k) {
      if (!std::isfinite(middle)) return Result::unknown;
      if (middle < 0) return Result::negative;
      if (middle <= nothing_) return Result::positive;
      if (k == most) return Result::unknown;
      const double centre = at_, low = std::max(centre - reach, 0.0),
                   high = std::min(centre + reach, 1.0);
      const double below = low > 0 ? value(low) : atLow_;
      if (below < 0) return at_ = low, Result::negative;
      const double above = high < 1 ? value(high) : atHigh_;
      if (above < 0) return at_ = high, Result::negative;
      if (!std::isfinite(below) || !std::isfinite(above)) return Result::unknown;
      const double left = (middle - below) / (centre - low),
                   right = (above - middle) / (high - centre);
      const double curvature = (right - left) / (high - low);
      const double vertex = 0.5 * (low + centre) - left / (2 * curvature);
      const double least = middle - curvature * (vertex - centre) * (vertex - centre);
      const bool inside = curvature > 0 && vertex > low && vertex < high;
      if (inside) {
        if (least > 0.1 * middle) return Result::positive;
      } else if (below < above ? low == 0 : high == 1) {
        return Result::positive;  // it falls towards an end of the step and is positive there
      }
      at_ = inside ? vertex : below < above ? low : high;
      middle = value(at_);
      reach = inside ? std::clamp(std::sqrt(std::abs(middle) / curvature), 1e-6, reach) : 2 * reach;
    }
  }
  double at() const { return at_; }

 private:
  double atLow_, atHigh_, nothing_, at_ = 0;
};

class Screening {
 public:
  Screening(Family& family, const StepEnd& low, const StepEnd& high,
            const std::vector<ContinuedPair>& singles, std::vector<Event>& events,
            std::vector<Gap>& gaps)
      : family_(family), low_(low), high_(high), singles_(singles), events_(events), gaps_(gaps) {
    std::vector<linalg::DensePair> below, above;
    for (const auto& single : singles) {
      below.push_back(single.below);
      above.push_back(single.above);
    }
    below_ = slopes(family.comm(), linalg::Spectrum(low.problem, below), low, high);
    above_ = slopes(family.comm(), linalg::Spectrum(high.problem, above), low, high);
  }

  void run() {
    const auto still = [&](const ContinuedPair& single) {
      return neutral(single.below.s, damped()) && neutral(single.above.s, damped());
    };
    for (std::size_t i = 0; i < singles_.size(); ++i)
      if (!still(singles_[i])) {
        const auto isNeutral = [&](const linalg::DensePair& end) {
          return neutral(end.s, damped());
        };
        if (!isNeutral(singles_[i].below) && !isNeutral(singles_[i].above))
          arch(i);
        else if (damped())
          fromNeutral(i);
      } else {
        for (std::size_t j = 0; j < i; ++j)
          if (still(singles_[j])) merger(i, j);
      }
  }

 private:
  double width() const { return high_.friction - low_.friction; }
  // At friction 0 there may be no damping matrix yet.
  bool damped() const { return !low_.problem.damping.empty() || !high_.problem.damping.empty(); }

  /// Returns the discriminant of two eigenvalues, or the growth rate of one, at t; NaN if the
  /// subspace is not found.
  double examine(double t, const std::vector<linalg::DensePair>& below,
                 const std::vector<linalg::DensePair>& above, double isolation) {
    const linalg::Spectrum from(t < 0.5 ? low_.problem : high_.problem, t < 0.5 ? below : above);
    const auto found = continuedTo(family_, low_.friction + t * width(), from,
                                   (1 - t) * mean(below) + t * mean(above), isolation);
    if (!found) return NAN;
    found_ = found->pairs();
    return found_.size() == 2 ? discriminant(found_, damped()) : found_[0].s.real();
  }

  /// Appends the two events that a search has found, or a gap if its result is unknown.
  void record(Dip::Result result, const Dip& dip, Event event) {
    if (result == Dip::Result::positive) return;
    if (result == Dip::Result::unknown) {
      gaps_.push_back(notExamined(low_.friction, high_.friction, event.below));
      return;
    }
    Event second = event;
    event.low = low_.friction;
    second.high = high_.friction;
    event.high = second.low = low_.friction + dip.at() * width();
    event.above = second.below = found_;
    second.loss = !event.loss;
    events_.push_back(std::move(event));
    events_.push_back(std::move(second));
  }

  /// Examines whether two neutral eigenvalues meet.
  void merger(std::size_t i, std::size_t j) {
    const ContinuedPair &a = singles_[i], &b = singles_[j];
    const double d0 = 0.5 * (a.below.s - b.below.s).imag(),
                 d1 = 0.5 * (a.above.s - b.above.s).imag();
    const double slope0 = 0.5 * (below_[i] - below_[j]).imag() * width(),
                 slope1 = 0.5 * (above_[i] - above_[j]).imag() * width();
    const Cubic square{d0 * d0, 2 * d0 * slope0, d1 * d1, 2 * d1 * slope1};
    double t = square.lowest();
    const bool crossing = d0 * d1 < 0;
    if (!crossing && square(t) > 0.5 * std::min(d0 * d0, d1 * d1)) return;
    if (crossing) t = d0 / (d0 - d1);
    const std::vector<linalg::DensePair> below{a.below, b.below}, above{a.above, b.above};
    const double isolation = isolationOf(i, j);
    Dip dip(d0 * d0, d1 * d1);
    // If they are equal at both ends, differences are round-off: only a significant growth
    // indicates a merger.
    const bool equalTwice = coincide(below) && coincide(above);
    const auto result = dip.search(equalTwice ? 0.5 : t, [&](double at) {
      const double value = examine(at, below, above, isolation);
      const bool nothing = equalTwice && !std::isnan(value) && neutralPair(found_, damped());
      return nothing ? 0 : value;
    });
    const bool lower = d0 < 0;  // a has the lower frequency and becomes the growing one
    record(result, dip,
           {Event::Kind::coalescence, lower ? a.branch : b.branch, lower ? b.branch : a.branch,
            true, 0, 0, below, above, isolation});
  }

  double isolationOf(std::size_t i, std::size_t j) const {
    const Complex below = 0.5 * (singles_[i].below.s + singles_[j].below.s),
                  above = 0.5 * (singles_[i].above.s + singles_[j].above.s);
    double distance = std::min(std::abs(below), std::abs(above));
    for (std::size_t k = 0; k < singles_.size(); ++k)
      if (k != i && k != j)
        distance = std::min({distance, std::abs(singles_[k].below.s - below),
                             std::abs(singles_[k].above.s - above)});
    return distance;
  }

  /// Examines whether the growth rate of an eigenvalue changes sign twice.
  void arch(std::size_t i) {
    const ContinuedPair& a = singles_[i];
    const double g0 = a.below.s.real(), g1 = a.above.s.real();
    if (g0 * g1 <= 0) return;
    const double sign = g0 > 0 ? 1 : -1;
    const Cubic growth{sign * g0, sign * below_[i].real() * width(), sign * g1,
                       sign * above_[i].real() * width()};
    const double t = growth.lowest();
    if (growth(t) > 0.1 * std::min(sign * g0, sign * g1)) return;
    const std::vector<linalg::DensePair> below{a.below}, above{a.above};
    Dip dip(sign * g0, sign * g1);
    const auto result =
        dip.search(t, [&](double at) { return sign * examine(at, below, above, a.isolation); });
    record(result, dip,
           {Event::Kind::crossing, a.branch, -1, sign < 0, 0, 0, below, above, a.isolation});
  }

  /// Examines an eigenvalue that is neutral at one end of the step.
  void fromNeutral(std::size_t i) {
    const ContinuedPair& a = singles_[i];
    const std::vector<linalg::DensePair> below{a.below}, above{a.above};
    const NeutralStep step{.event = {.branch = a.branch,
                                     .low = low_.friction,
                                     .high = high_.friction,
                                     .below = below,
                                     .above = above,
                                     .isolation = a.isolation},
                           .slopeBelow = below_[i].real(),
                           .slopeAbove = above_[i].real(),
                           .pairAt = [&](double friction) {
                             const double t = (friction - low_.friction) / width();
                             return std::isnan(examine(t, below, above, a.isolation))
                                        ? std::vector<linalg::DensePair>()
                                        : found_;
                           }};
    if (!changesSignWithin(step)) return;
    auto found = changesOf(step);
    if (!found) return gaps_.push_back(notExamined(low_.friction, high_.friction, below));
    std::erase_if(events_, [&](const Event& event) {  // that of crossing()
      return event.kind == Event::Kind::crossing && event.branch == a.branch;
    });
    for (auto& event : *found) events_.push_back(std::move(event));
  }

  Family& family_;
  StepEnd low_, high_;
  const std::vector<ContinuedPair>& singles_;
  std::vector<Event>& events_;
  std::vector<Gap>& gaps_;
  std::vector<Complex> below_, above_;  // slopes at both ends
  std::vector<linalg::DensePair> found_;
};

}  // namespace

void screen(Family& family, const StepEnd& low, const StepEnd& high,
            const std::vector<ContinuedPair>& singles, std::vector<Event>& events,
            std::vector<Gap>& gaps) {
  Screening(family, low, high, singles, events, gaps).run();
}

}  // namespace squeal::tracking
