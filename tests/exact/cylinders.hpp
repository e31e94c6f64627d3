// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Two concentric cylinders in plane strain, pressed together by a pressure in the bore: Lamé's
/// solution.

namespace squeal::exact::cylinders {

/// A cylinder r1 ≤ r ≤ r2 under pressures p1 inside and p2 outside:
///   u(r) = (1 + ν)/E · [(1 − 2ν)(p1 r1² − p2 r2²) r + (p1 − p2) r1² r2² / r] / (r2² − r1²).
struct Cylinder {
  double young, poisson, r1, r2;
  constexpr double displacement(double r, double p1, double p2) const {
    return (1 + poisson) / young *
           ((1 - 2 * poisson) * (p1 * r1 * r1 - p2 * r2 * r2) * r +
            (p1 - p2) * r1 * r1 * r2 * r2 / r) /
           (r2 * r2 - r1 * r1);
  }
};

/// The bore r = a of the inner cylinder carries p0, the rim r = c of the outer one nothing. Without
/// friction the two meet at r = b with the pressure p that makes their radial displacements there
/// equal: u_inner(b; p0, p) = u_outer(b; p, 0), linear in p.
inline constexpr double a = 0.05, b = 0.08, c = 0.12, borePressure = 3e6;
inline constexpr Cylinder inner{7e10, 0.33, a, b}, outer{2.1e11, 0.3, b, c};

inline double contactPressure() {
  return inner.displacement(b, borePressure, 0) /
         (outer.displacement(b, 1, 0) - inner.displacement(b, 0, 1));
}

}  // namespace squeal::exact::cylinders
