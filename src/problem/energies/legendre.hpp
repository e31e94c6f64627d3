// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Legendre polynomials, which keep fits of motions well conditioned.
#include <array>
#include <cstddef>

namespace squeal::energies {

/// Returns the Legendre polynomials of the degrees 0 … count − 1 at x in [−1, 1].
template <std::size_t count>
std::array<double, count> legendre(double x) {
  static_assert(count >= 2);
  std::array<double, count> p{1, x};
  for (std::size_t k = 2; k < count; ++k)
    p[k] = ((2.0 * k - 1) * x * p[k - 1] - (k - 1.0) * p[k - 2]) / k;
  return p;
}

}  // namespace squeal::energies
