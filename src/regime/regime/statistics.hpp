// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Statistics of the cycles of a time integration.
#include <cstddef>
#include <span>

namespace squeal::regime {

/// Returns the mean; 0 for no values.
double mean(std::span<const double> x);
/// Returns the standard deviation; 0 for no values.
double deviation(std::span<const double> x);
/// Returns the position of the maximum at or after the index `first`, interpolated by a parabola
/// through the logarithms of the largest entry and its two neighbours.
double peakPlace(std::span<const double> power, std::size_t first);

}  // namespace squeal::regime
