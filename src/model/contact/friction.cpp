// SPDX-License-Identifier: BSD-2-Clause
#include "model/contact/friction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace squeal::contact {

FrictionLaw FrictionLaw::exponential(double staticRatio, double decaySpeed) {
  FrictionLaw law;
  law.kind_ = Kind::exponential;
  law.staticRatio_ = staticRatio;
  law.decaySpeed_ = decaySpeed;
  return law;
}

FrictionLaw FrictionLaw::table(std::vector<double> speeds, std::vector<double> factors) {
  FrictionLaw law;
  law.kind_ = Kind::table;
  law.speeds_ = std::move(speeds);
  law.factors_ = std::move(factors);
  return law;
}

/// Returns the number of knots of the table at or below the speed.
std::size_t FrictionLaw::interval(double speed) const {
  return std::upper_bound(speeds_.begin(), speeds_.end(), speed) - speeds_.begin();
}

double FrictionLaw::value(double speed) const {
  if (kind_ == Kind::constant) return 1;
  if (kind_ == Kind::exponential) return 1 + (staticRatio_ - 1) * std::exp(-speed / decaySpeed_);
  const std::size_t i = interval(speed);
  if (i == 0) return factors_.front();
  return factors_[i - 1] + slope(speed) * (speed - speeds_[i - 1]);
}

double FrictionLaw::slope(double speed) const {
  if (kind_ == Kind::constant) return 0;
  if (kind_ == Kind::exponential)
    return -(staticRatio_ - 1) / decaySpeed_ * std::exp(-speed / decaySpeed_);
  const std::size_t i = interval(speed);
  if (i == 0 || i == speeds_.size()) return 0;
  return (factors_[i] - factors_[i - 1]) / (speeds_[i] - speeds_[i - 1]);
}

}  // namespace squeal::contact
