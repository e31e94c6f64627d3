// SPDX-License-Identifier: BSD-2-Clause
#include "regime/regime/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace squeal::regime {

double mean(std::span<const double> x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / std::max<std::size_t>(1, x.size());
}

double deviation(std::span<const double> x) {
  const double m = mean(x);
  double sum = 0;
  for (const double a : x) sum += (a - m) * (a - m);
  return std::sqrt(sum / std::max<std::size_t>(1, x.size()));
}

double peakPlace(std::span<const double> power, std::size_t first) {
  const std::size_t i = std::max_element(power.begin() + first, power.end()) - power.begin();
  if (i == 0 || i + 1 >= power.size() || power[i - 1] <= 0 || power[i + 1] <= 0) return i;
  const double a = std::log(power[i - 1]), b = std::log(power[i]), c = std::log(power[i + 1]);
  const double curvature = a - 2 * b + c;
  return i + (curvature < 0 ? 0.5 * (a - c) / curvature : 0);
}

}  // namespace squeal::regime
