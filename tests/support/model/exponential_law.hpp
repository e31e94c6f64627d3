// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The exponential friction law φ(|w|) = 1 + (r − 1) exp(−|w|/v), and a table that is its tangent.
#include <cmath>
#include <string>

#include "base/system/text.hpp"

namespace squeal::test {

struct ExponentialLaw {
  double ratio, decaySpeed;  ///< r; v, m/s
  double value(double speed) const { return 1 + (ratio - 1) * std::exp(-speed / decaySpeed); }
  double slope(double speed) const {
    return -(ratio - 1) / decaySpeed * std::exp(-speed / decaySpeed);
  }
  std::string options() const {
    return formatted(
        " -friction_law exponential -friction_static_ratio %.17g -friction_decay_speed %.17g",
        ratio, decaySpeed);
  }
  /// A table of the same value and slope at one speed.
  std::string tangentOptions(double speed) const {
    const double change = slope(speed) * speed / 5;
    return formatted(
        " -friction_law table -friction_table_speed 0,%.17g,%.17g,1 -friction_table_factor "
        "9,%.17g,%.17g,7",
        0.8 * speed, 1.2 * speed, value(speed) - change, value(speed) + change);
  }
};

}  // namespace squeal::test
