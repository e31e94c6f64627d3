// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Two concentric rings bonded to each other, cylindrically orthotropic, in plane strain, under a
/// pressure in the bore (Lekhnitskii, Anisotropic Plates, for one ring).
#include <array>
#include <cmath>
#include <utility>

namespace squeal::exact::orthotropic_rings {

/// The law of a ring in the plane, Pa: σ_r = d11 ε_r + d12 ε_θ, σ_θ = d12 ε_r + d22 ε_θ.
struct Ring {
  double d11, d22, d12;
  /// Without body forces d11 (u″ + u′/r) = d22 u/r²: u = A r^k + B r^−k.
  double exponent() const { return std::sqrt(d22 / d11); }
  /// Radial stress of u = r^e.
  double stress(double e, double r) const { return (d11 * e + d12) * std::pow(r, e - 1); }
};

/// The radial displacement u = A_i r^k_i + B_i r^−k_i in a < r < b (i = 0) and b < r < c (i = 1).
class Solution {
 public:
  Solution(const Ring& inner, const Ring& outer, std::array<double, 3> radii, double pressure)
      : exponent_{inner.exponent(), outer.exponent()}, middle_(radii[1]) {
    const auto [a, b, c] = radii;
    const double k = exponent_[0], q = exponent_[1];
    // σ_r(a) = −p, u and σ_r continuous at b, σ_r(c) = 0.
    double m[4][5] = {
        {inner.stress(k, a), inner.stress(-k, a), 0, 0, -pressure},
        {std::pow(b, k), std::pow(b, -k), -std::pow(b, q), -std::pow(b, -q), 0},
        {inner.stress(k, b), inner.stress(-k, b), -outer.stress(q, b), -outer.stress(-q, b), 0},
        {0, 0, outer.stress(q, c), outer.stress(-q, c), 0}};
    for (int i = 0; i < 4; ++i) {
      int pivot = i;
      for (int j = i + 1; j < 4; ++j)
        if (std::abs(m[j][i]) > std::abs(m[pivot][i])) pivot = j;
      std::swap(m[i], m[pivot]);
      for (int j = 0; j < 4; ++j) {
        if (j == i) continue;
        const double factor = m[j][i] / m[i][i];
        for (int l = i; l < 5; ++l) m[j][l] -= factor * m[i][l];
      }
    }
    for (int i = 0; i < 4; ++i) coefficient_[i] = m[i][4] / m[i][i];
  }
  double displacement(double r) const {
    const int i = r < middle_ ? 0 : 1;
    return coefficient_[2 * i] * std::pow(r, exponent_[i]) +
           coefficient_[2 * i + 1] * std::pow(r, -exponent_[i]);
  }

 private:
  double exponent_[2], middle_, coefficient_[4];
};

}  // namespace squeal::exact::orthotropic_rings
