// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/tracking/growth.hpp"

#include <algorithm>

#include "eigen/tracking/join.hpp"

namespace squeal::tracking {

int sign(Complex s, bool damped) { return neutral(s, damped) ? 0 : s.real() > 0 ? 1 : -1; }

int growthOf(const std::vector<linalg::DensePair>& pairs, std::size_t k, bool damped) {
  return sign(coincide(pairs) ? mean(pairs) : pairs[k].s, damped);
}

bool damped(const linalg::Spectrum& low, const linalg::Spectrum& high) {
  return low.damped() || high.damped();
}

bool changes(int before, int after) { return before != after && std::max(before, after) == 1; }

bool meetingPoint(Complex s, bool damped) { return neutral(s, damped) || (!damped && real(s)); }

int unstable(const std::vector<linalg::DensePair>& pairs, bool damped) {
  return std::ranges::count_if(pairs, [&](const auto& p) { return sign(p.s, damped) > 0; });
}

}  // namespace squeal::tracking
