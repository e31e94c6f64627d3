// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Two oscillators that friction couples.
#include <cmath>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "support/algebra/dense.hpp"

namespace squeal::test {

/// Mode coupling (Hoffmann, Fischer, Allgaier and Gaul 2002, in normal form): M = I, K = [k1, f k3;
/// −f k3, k2].
///   μ = −s²:  (k1 − μ)(k2 − μ) + f² k3² = 0,  μ = (k1 + k2)/2 ± √((k1 − k2)²/4 − f² k3²)
/// The frequencies merge at f = |k1 − k2| / (2 k3); beyond, μ = a ± ib and s = √(−μ):
///   growth √((|μ| − a)/2), frequency √((|μ| + a)/2).
struct Oscillators {
  double k1, k2, k3;
  double critical() const { return std::abs(k1 - k2) / (2 * k3); }
  linalg::DenseMatrix stiffness(double f) const { return square({k1, -f * k3, f * k3, k2}); }
  /// Returns the eigenvalues with Im s ≥ 0, by ascending frequency, then growth.
  std::vector<Complex> exact(double f) const {
    const double a = (k1 + k2) / 2, inside = (k1 - k2) * (k1 - k2) / 4 - f * f * k3 * k3;
    if (inside >= 0)
      return {{0, std::sqrt(a - std::sqrt(inside))}, {0, std::sqrt(a + std::sqrt(inside))}};
    const double size = std::hypot(a, std::sqrt(-inside)), growth = std::sqrt((size - a) / 2),
                 frequency = std::sqrt((size + a) / 2);
    return {{-growth, frequency}, {growth, frequency}};
  }
};

}  // namespace squeal::test
