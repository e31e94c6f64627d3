// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The root of a continuous function in a bracket.

namespace squeal::stability {

/// Finds the root of a continuous function in a bracket by the method of T. R. Chandrupatla
/// (Advances in Engineering Software 28 (1997) 145–149): inverse quadratic interpolation if it is
/// safe, otherwise bisection. The caller evaluates the function at next() and passes the value to
/// take().
class BracketedRoot {
 public:
  /// A point and the value of the function there.
  struct End {
    double at, value;
  };
  /// The values at `a` and `b` must have different signs.
  BracketedRoot(End a, End b, double tolerance)
      : a_(a), b_(b), c_(a), part_(a.value / (a.value - b.value)), tolerance_(tolerance) {}
  double next() const { return a_.at + part_ * (b_.at - a_.at); }
  void take(double value);
  bool done() const { return done_; }
  double root() const;

 private:
  End a_, b_, c_;  // the latest point, the other end of the bracket, and the previous point
  double part_, tolerance_;
  int count_ = 0;
  bool done_ = false;
};

}  // namespace squeal::stability
