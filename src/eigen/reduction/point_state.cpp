// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/point_state.hpp"

#include <cmath>
#include <utility>

namespace squeal::reduction {

void PointSolution::truncate(double top) {
  auto& [band, guard, improved] = spectrum;
  std::size_t kept = 0;
  for (std::size_t j = 0; j < band.size(); ++j) {
    if (std::abs(band[j].s) > top) {
      guard.push_back(std::move(band[j]));
      continue;
    }
    errors[kept] = errors[j];
    if (kept != j) band[kept] = std::move(band[j]);
    ++kept;
  }
  band.resize(kept);
  errors.resize(kept);
}

}  // namespace squeal::reduction
