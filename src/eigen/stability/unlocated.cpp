// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/stability/unlocated.hpp"

#include <algorithm>
#include <iterator>

#include "eigen/tracking/growth.hpp"

namespace squeal::stability {
namespace {

/// Returns the unstable eigenvalue of the band that grows fastest; null if all are stable.
const linalg::DensePair* fastest(const Station& station, bool damped) {
  const linalg::DensePair* found = nullptr;
  for (std::size_t j = 0; j < station.pairs.size(); ++j) {
    const auto& pair = station.pairs[j];
    if (station.inBand[j] && tracking::sign(pair.s, damped) > 0 &&
        (!found || pair.s.real() > found->s.real()))
      found = &pair;
  }
  return found;
}

}  // namespace

std::vector<std::pair<double, double>> directJumps(const tracking::Branches& branches) {
  std::vector<std::pair<double, double>> jumps;
  const auto& stations = branches.stations;
  for (std::size_t k = 1; k < stations.size(); ++k)
    if (stations[k].piece != stations[k - 1].piece &&
        stations[k].friction > stations[k - 1].friction)
      jumps.emplace_back(stations[k - 1].friction, stations[k].friction);
  return jumps;
}

void addUnlocatedChanges(TrackedLine& line) {
  const auto& stations = line.branches.stations;
  std::vector<Critical> found;
  for (std::size_t k = 1; k < stations.size(); ++k) {
    const Station &low = stations[k - 1], &high = stations[k];
    const auto *below = fastest(low, line.isDamped), *above = fastest(high, line.isDamped);
    if ((below == nullptr) == (above == nullptr)) continue;
    if (std::ranges::any_of(line.criticals, [&](const Critical& known) {
          return known.friction + known.errorEstimate >= low.friction &&
                 known.friction - known.errorEstimate <= high.friction;
        }))
      continue;
    const Complex s = (above ? above : below)->s;
    Critical added{.kind = low.piece != high.piece ? Event::Kind::contact
                           : s.imag() == 0         ? Event::Kind::divergence
                                                   : Event::Kind::crossing,
                   .friction = 0.5 * (low.friction + high.friction),
                   .angularFrequency = s.imag(),
                   .loss = above != nullptr,
                   .errorEstimate = 0.5 * (high.friction - low.friction),
                   .converged = false,
                   .piece = low.piece};
    found.push_back(added);
  }
  for (const auto& critical : found) {
    const auto place =
        std::ranges::upper_bound(line.criticals, critical.friction, {}, &Critical::friction);
    const auto index = std::distance(line.criticals.begin(), place);
    line.criticals.insert(place, critical);
    line.criticalModes.insert(line.criticalModes.begin() + index, pencil::CriticalMode());
  }
}

}  // namespace squeal::stability
