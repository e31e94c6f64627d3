// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Beams of steel by the theories of beams and of rods: clamped at one end and free at the other,
/// or free at both.
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace squeal::exact::beam {

inline constexpr double young = 2.1e11, density = 7850;
inline double shear(double poisson) { return young / (2 * (1 + poisson)); }

/// The first `count` roots of `f` from `start` on, bracketed by small steps.
inline std::vector<double> roots(const std::function<double(double)>& f, double start,
                                 double factor, std::size_t count) {
  std::vector<double> found;
  for (double low = start; found.size() < count; low *= factor) {
    double a = low, b = low * factor;
    if (f(a) * f(b) > 0) continue;
    for (int i = 0; i < 100; ++i) (f(a) * f((a + b) / 2) <= 0 ? b : a) = (a + b) / 2;
    found.push_back((a + b) / 2);
  }
  return found;
}

struct Section {
  double length, width, height;  // bending along the height
};

/// The quantities of Huang's equations (1961, J. Appl. Mech. 28, 579) at a value of b:
///   b² = ρ A L⁴ ω² / (E I),  r² = I / (A L²),  s² = E I / (κ A G L²),
///   α, β = √(½ (∓(r² + s²) + √((r² − s²)² + 4/b²))).
struct Huang {
  double b, r2, s2, difference;  // r² − s²
  double even, odd, root;        // cosh bα cos bβ, sinh bα sin bβ, √(1 − b² r² s²)
};

/// Angular frequencies of a Timoshenko beam whose ends satisfy an equation.
inline std::vector<double> bending(const Section& section, double poisson, std::size_t count,
                                   double (*equation)(const Huang&)) {
  const double inertia = section.height * section.height / 12;    // I / A
  const double kappa = 10 * (1 + poisson) / (12 + 11 * poisson);  // Cowper 1966
  const double l2 = section.length * section.length, r2 = inertia / l2,
               s2 = young / (kappa * shear(poisson)) * r2;
  const auto of = [&](double b) {
    const double root = std::sqrt((r2 - s2) * (r2 - s2) + 4 / (b * b));
    const double alpha = std::sqrt((root - r2 - s2) / 2), beta = std::sqrt((root + r2 + s2) / 2);
    return equation({b, r2, s2, r2 - s2, std::cosh(b * alpha) * std::cos(b * beta),
                     std::sinh(b * alpha) * std::sin(b * beta), std::sqrt(1 - b * b * r2 * s2)});
  };
  auto list = roots(of, 1, 1.01, count);
  for (auto& b : list) b *= std::sqrt(young * inertia / density) / l2;
  return list;
}

/// Clamped at one end, free at the other:
///   2 + (b² (r² − s²)² + 2) cosh bα cos bβ − b (r² + s²) / √(1 − b² r² s²) sinh bα sin bβ = 0.
inline std::vector<double> bending(const Section& section, double poisson, std::size_t count) {
  return bending(section, poisson, count, [](const Huang& h) {
    return 2 + (h.b * h.b * h.difference * h.difference + 2) * h.even -
           h.b * (h.r2 + h.s2) / h.root * h.odd;
  });
}

/// Free at both ends:
///   2 − 2 cosh bα cos bβ + b / √(1 − b² r² s²) (b² r² (r² − s²)² + 3 r² − s²) sinh bα sin bβ = 0.
inline std::vector<double> freeBending(const Section& section, double poisson, std::size_t count) {
  return bending(section, poisson, count, [](const Huang& h) {
    return 2 - 2 * h.even +
           h.b / h.root * (h.b * h.b * h.r2 * h.difference * h.difference + 3 * h.r2 - h.s2) *
               h.odd;
  });
}

/// First torsion of a rod whose end sections may warp: ω = (π / 2L) √(G J / ρ I_p), J of a
/// rectangle by Saint-Venant's series.
inline double torsion(const Section& section, double poisson) {
  const double a = std::max(section.width, section.height),
               b = std::min(section.width, section.height);
  double sum = 0;
  for (int n = 1; n < 20; n += 2) sum += std::tanh(n * M_PI * a / (2 * b)) / std::pow(n, 5);
  const double j = a * b * b * b * (1.0 / 3 - 64 * b / (std::pow(M_PI, 5) * a) * sum),
               polar = a * b * (a * a + b * b) / 12;
  return M_PI / (2 * section.length) * std::sqrt(shear(poisson) * j / (density * polar));
}

/// First axial vibration.
inline double axial(double length) { return M_PI / (2 * length) * std::sqrt(young / density); }

}  // namespace squeal::exact::beam
