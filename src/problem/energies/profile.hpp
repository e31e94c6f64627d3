// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Sign changes in the profile of a motion.
#include <algorithm>
#include <cmath>
#include <vector>

namespace squeal::energies {

/// Returns the number of sign changes of a profile, ignoring values whose magnitude is below 5 % of
/// the largest one.
inline int signChanges(const std::vector<double>& profile) {
  double most = 0;
  for (const double value : profile) most = std::max(most, std::abs(value));
  int count = 0, sign = 0;
  for (const double value : profile) {
    if (std::abs(value) < 0.05 * most) continue;
    const int now = value > 0 ? 1 : -1;
    if (sign != 0 && now != sign) ++count;
    sign = now;
  }
  return count;
}

}  // namespace squeal::energies
