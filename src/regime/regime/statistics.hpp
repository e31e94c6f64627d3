// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Statistics of the cycles of a march.
#include <cstddef>
#include <span>

namespace squeal::regime {

/// Returns the mean; 0 for no values.
double mean(std::span<const double> x);
/// Returns the standard deviation; 0 for no values.
double deviation(std::span<const double> x);
/// Returns the index of the largest entry from `first` on, refined by a parabola through the
/// logarithms of its neighbours.
double peakPlace(std::span<const double> power, std::size_t first);

}  // namespace squeal::regime
