// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// An independent march of the tube on a shaft: the leapfrog rule node by node, without matrices.
#include "support/regime/reduced_models.hpp"

namespace squeal::test {

/// One wavelength of the tube with lumped masses, U and V as they are. No node lies below the shaft
/// at the end of a step.
class TubeMarch {
 public:
  TubeMarch(const Tube& tube, const Wave& wave, double f, double delta, double viscosity, int count)
      : tube_(tube), f_(f), delta_(delta), viscosity_(viscosity), count_(count) {
    spacing_ = wave.wavelength / count;
    u_.assign(count, delta), rateU_.assign(count, 0), force_ = rateU_;
    for (int i = 0; i < count; ++i) {
      v_.push_back(f * tube.g * delta / tube.h + wave.y(spacing_ * i) / wave.c);
      rateV_.push_back(wave.slope(spacing_ * i));
    }
    accelerationU_ = accelerationV_ = force_;
  }

  void step(double h) {
    accelerate();
    for (int i = 0; i < count_; ++i) {
      const double free = rateU_[i] + h * accelerationU_[i], least = (delta_ - u_[i]) / h;
      rateU_[i] = std::max(free, least);
      force_[i] = (rateU_[i] - free) / h;
      const double slipping = rateV_[i] + h * accelerationV_[i], limit = f_ * force_[i];
      // The shaft turns with speed 1.
      rateV_[i] = slipping + h * std::clamp((1 - slipping) / h, -limit, limit);
      u_[i] += h * rateU_[i], v_[i] += h * rateV_[i];
    }
  }

  double open() const { return double(std::ranges::count(force_, 0.0)) / count_; }
  std::complex<double> harmonic() const {
    std::complex<double> sum = 0;
    for (int i = 0; i < count_; ++i) sum += v_[i] * std::polar(1.0, 2 * M_PI * i / count_);
    return sum;
  }

 private:
  void accelerate() {
    const double s = spacing_;
    for (int i = 0; i < count_; ++i) {
      const int a = i > 0 ? i - 1 : count_ - 1, b = i + 1 < count_ ? i + 1 : 0;
      const auto second = [&](const std::vector<double>& x) {
        return (x[a] - 2 * x[i] + x[b]) / (s * s);
      };
      accelerationU_[i] = tube_.b * second(u_) - tube_.d * (v_[b] - v_[a]) / (2 * s) -
                          tube_.g * u_[i] + viscosity_ * second(rateU_);
      accelerationV_[i] = tube_.a * second(v_) + tube_.d * (u_[b] - u_[a]) / (2 * s) -
                          tube_.h * v_[i] + viscosity_ * second(rateV_);
    }
  }

  Tube tube_;
  double f_, delta_, viscosity_, spacing_ = 0;
  int count_;
  std::vector<double> u_, v_, rateU_, rateV_, accelerationU_, accelerationV_, force_;
};

/// Marches over some periods and measures frequency and open part over further ones.
inline Marched marched(TubeMarch march, double period, int steps, int settle, int measure) {
  const double h = period / steps;
  for (int i = 0; i < settle * steps; ++i) march.step(h);
  Marched result;
  double turned = 0;
  std::complex<double> before = march.harmonic();
  for (int i = 1; i <= measure * steps; ++i) {
    march.step(h);
    result.open += march.open();
    if (i % 64 != 0) continue;  // far from half a turn
    const std::complex<double> now = march.harmonic();
    turned += std::arg(now / before);
    before = now;
  }
  result.omega = std::abs(turned) / (measure * steps / 64 * 64 * h);
  result.open /= measure * steps;
  return result;
}

}  // namespace squeal::test
