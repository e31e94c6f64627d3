#pragma once
/// This file holds Coulomb friction with the coefficient f φ(|w|): f is swept, and options give the
/// law φ of the sliding speed.
#include <vector>

namespace squeal::contact {

/// A FrictionLaw is the law φ(|w|), dimensionless: constant 1, an exponential decay from a static
/// to the kinetic value, or a table.
class FrictionLaw {
 public:
  /// Not collective. Returns the law that the options `-friction_*` ask for. Throws Error for a
  /// table whose lists differ in length or whose speeds do not ascend, and for options of another
  /// law.
  static FrictionLaw read();
  bool constant() const { return kind_ == Kind::constant; }
  /// Returns φ at the sliding speed |w|, m/s.
  double value(double speed) const;
  /// Returns dφ/d|w|, s/m. At a knot of a table it is the slope of the interval that begins there,
  /// and zero at the last one.
  double slope(double speed) const;

 private:
  enum class Kind { constant, exponential, table };
  std::size_t interval(double speed) const;
  Kind kind_ = Kind::constant;
  double staticRatio_ = 1, decaySpeed_ = 1;
  std::vector<double> speeds_, factors_;
};

}  // namespace squeal::contact
