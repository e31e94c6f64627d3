// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Coulomb friction with the coefficient f φ(|w|): f is swept, and φ is a law of the sliding speed.
#include <vector>

namespace squeal::contact {

/// The law φ(|w|), dimensionless: constant 1, an exponential decay from a static to the kinetic
/// value, or a table.
class FrictionLaw {
 public:
  /// Creates the constant law.
  FrictionLaw() = default;
  /// Returns 1 + (r − 1) exp(−|w|/v) for the static ratio r and the decay speed v, m/s.
  static FrictionLaw exponential(double staticRatio, double decaySpeed);
  /// Returns the law that interpolates linearly between these factors at ascending speeds, m/s. It
  /// is constant below the first and above the last speed.
  static FrictionLaw table(std::vector<double> speeds, std::vector<double> factors);
  bool constant() const { return kind_ == Kind::constant; }
  /// Returns φ at the sliding speed |w|, m/s.
  double value(double speed) const;
  /// Returns dφ/d|w|, s/m. At a point of a table, this is the slope of the interval that begins at
  /// the point, and zero at the last point.
  double slope(double speed) const;

 private:
  enum class Kind { constant, exponential, table };
  std::size_t interval(double speed) const;
  Kind kind_ = Kind::constant;
  double staticRatio_ = 1, decaySpeed_ = 1;
  std::vector<double> speeds_, factors_;
};

}  // namespace squeal::contact
