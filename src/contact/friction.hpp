#pragma once
/// Coulomb friction with a coefficient f φ(|w|): f is swept, the law φ of the sliding speed is
/// given by options.
#include <vector>

namespace squeal::contact {

/// φ(|w|), dimensionless: constant 1, exponential decay from a static to the kinetic value, or a
/// table.
class FrictionLaw {
 public:
  /// Reads `-friction_*`. Errors: a table whose lists differ in length or whose speeds do not
  /// ascend; options of another law.
  static FrictionLaw read();
  bool constant() const { return kind_ == Kind::constant; }
  /// φ at the sliding speed |w|, m/s.
  double value(double speed) const;
  /// dφ/d|w|, s/m; at a knot of a table the slope of the interval that begins there.
  double slope(double speed) const;

 private:
  enum class Kind { constant, exponential, table };
  std::size_t interval(double speed) const;
  Kind kind_ = Kind::constant;
  double staticRatio_ = 1, decaySpeed_ = 1;
  std::vector<double> speeds_, factors_;
};

}  // namespace squeal::contact
