// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The largest of several errors. A comparison with NaN is false, so that std::max(worst, NaN) is
/// `worst`: a NaN would pass a test that accumulates errors by std::max.
#include <cmath>
#include <cstddef>
#include <span>

namespace squeal::test {

/// Returns the larger of two errors, or NaN if one of them is NaN.
inline double worse(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

/// Returns the largest of several errors, at least 0, or NaN if one of them is NaN.
inline double worst(std::span<const double> errors) {
  double result = 0;
  for (const double error : errors) result = worse(result, error);
  return result;
}

}  // namespace squeal::test
