// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The two layers of two_layers.hpp with external damping, at the frictions where a wave begins to
/// grow.
#include "exact/two_layers.hpp"

namespace squeal::exact::two_layers {

/// Damping α M of both layers: s² + α s stands for s² of the undamped waves, for every mode.
/// Without friction all waves but those with k = 0 come in pairs of equal frequency, both damped by
/// α/2; friction parts them at once, and one of each pair may reach the axis.
inline constexpr double alpha = 0.02;

/// A wave that neither grows nor decays.
struct Wave {
  double friction, omega;
};

/// Returns the wave of wave number index n to which Newton's method in (f, ω) leads; NaN if to
/// none.
inline Wave waveNear(Wave at, int n) {
  const auto value = [&](double f, double omega) {
    const Complex s(0, omega);
    return characteristic({f}, n, std::sqrt(s * s + alpha * s));
  };
  for (int k = 0; k < 30; ++k) {
    constexpr double h = 1e-6;
    const Complex here = value(at.friction, at.omega);
    const Complex df = (value(at.friction + h, at.omega) - value(at.friction - h, at.omega)) /
                       (2 * h),
                  dw = (value(at.friction, at.omega + h) - value(at.friction, at.omega - h)) /
                       (2 * h);
    const double det = df.real() * dw.imag() - df.imag() * dw.real();
    const double stepF = (here.real() * dw.imag() - here.imag() * dw.real()) / det,
                 stepW = (df.real() * here.imag() - df.imag() * here.real()) / det;
    at.friction -= stepF, at.omega -= stepW;
    if (!(std::abs(stepF) + std::abs(stepW) < 1)) return {NAN, NAN};
    if (std::abs(stepF) + std::abs(stepW) < 1e-13) return at;
  }
  return {NAN, NAN};
}

/// The closest of all wave numbers.
inline Wave closest(const Wave& found) {
  Wave best{NAN, NAN};
  double distance = INFINITY;
  for (int n = -8; n <= 8; ++n) {
    const Wave exact = waveNear(found, n);
    const double here = std::abs(exact.friction - found.friction) +
                        std::abs(exact.omega - found.omega) / found.omega;
    if (here < distance) best = exact, distance = here;
  }
  return best;
}

}  // namespace squeal::exact::two_layers
