// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The search for the critical friction of one event.
#include <cmath>
#include <vector>

#include "algebra/linalg/rayleigh_ritz.hpp"
#include "eigen/stability/critical.hpp"
#include "eigen/tracking/family.hpp"
#include "eigen/tracking/join.hpp"

namespace squeal::stability {

/// Locates the critical friction of an event, in a basis that is improved between the calls of
/// locate(). Not collective.
class CriticalRoot {
 public:
  /// Borrows the event.
  CriticalRoot(const Event& event, double tolerance)
      : event_(event),
        tolerance_(tolerance),
        throughZero_(tracking::real(event.below[0].s) && tracking::real(event.above[0].s)) {}

  /// Locates the critical friction in the current basis. `changed` is true if the basis differs
  /// from that of the last call.
  void locate(Family& family, bool changed);
  /// Returns true if the friction (at a jump, the eigenvalue) no longer moves, or was not found.
  bool settled() const { return settled_; }
  /// Returns true if eigenvalues are known at the friction found so far.
  bool found() const { return !known_.empty() && !std::isnan(friction_) && !lost_; }
  /// Returns the friction with a single pair at it. Its eigenvalue is the mean of the eigenvalues
  /// of the event: where two eigenvalues meet, so do their vectors.
  tracking::PairsAtFriction located() const;
  /// Stores the backward error and a bound on the round-off in yᴴP(s)x for unit vectors x and y.
  /// The backward error is NaN if no problem exists at the located friction.
  void setErrors(double backwardError, double roundOff);

  /// Returns the critical friction found so far.
  Critical result() const;

 private:
  /// The eigenvalues at a friction, and the function of the event there.
  struct Sample {
    double friction, value;
    linalg::Spectrum spectrum;
    const std::vector<linalg::DensePair>& pairs() const { return spectrum.pairs(); }
  };

  /// Returns true if the eigenvalue jumps at a known friction.
  bool jumps() const { return event_.kind == Event::Kind::contact && event_.low == event_.high; }
  void locateJump(Family& family, bool changed);
  double measure(const linalg::Spectrum& spectrum) const;
  const Sample& nearest(double friction) const;
  Complex expected(double friction) const;
  double valueAt(Family& family, double friction);
  std::vector<const Sample*> starts(double friction) const;
  bool reach(Family& family, double friction);
  double rootTolerance() const;
  double roundOffError() const;
  double width() const { return event_.high - event_.low; }
  /// Returns the tolerance of a root in a basis that is not final. It is small compared with the
  /// change of the root in the next basis.
  double roughly() const { return 1e-7 * width(); }

  double searchFromEnds(Family& family);
  double searchAgain(Family& family);
  double search(Family& family, double low, double high, double tolerance);
  double refined(Family& family);

  const Event& event_;
  double tolerance_;
  bool throughZero_;  // s is real at both ends; in a problem in s², only s² is analytic there
  double friction_ = NAN, moved_ = 0, backwardError_ = 0, roundOff_ = 0, slope_ = 0;
  bool settled_ = false, lost_ = false;
  std::vector<Sample> known_;  // the two ends of the bracket first; at a jump, one sample
};

}  // namespace squeal::stability
