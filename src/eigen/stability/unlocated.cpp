// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/stability/unlocated.hpp"

#include <algorithm>
#include <iterator>

#include "eigen/tracking/growth.hpp"

namespace squeal::stability {
namespace {

bool isUnstable(const Station& station, std::size_t pair, bool damped) {
  return tracking::sign(station.pairs[pair].s, damped) > 0;
}

/// Returns true if the band has an unstable eigenvalue.
bool isUnstable(const Station& station, bool damped) {
  for (std::size_t j = 0; j < station.pairs.size(); ++j)
    if (station.inBand[j] && isUnstable(station, j, damped)) return true;
  return false;
}

/// Returns true if the branch is unstable at the station, in the band or in its guard zone.
bool isUnstable(const Station& station, int branch, bool damped) {
  for (std::size_t j = 0; j < station.pairs.size(); ++j)
    if (branch != 0 && station.branch[j] == branch) return isUnstable(station, j, damped);
  return false;
}

/// Returns the unstable eigenvalue of the band that grows fastest, of those that are not unstable
/// at the other station; null if there is none.
const linalg::DensePair* changed(const Station& station, const Station& other, bool damped) {
  const linalg::DensePair* found = nullptr;
  for (std::size_t j = 0; j < station.pairs.size(); ++j) {
    const auto& pair = station.pairs[j];
    if (station.inBand[j] && isUnstable(station, j, damped) &&
        !isUnstable(other, station.branch[j], damped) &&
        (!found || pair.s.real() > found->s.real()))
      found = &pair;
  }
  return found;
}

Event::Kind kindOf(const Station& low, const Station& high, Complex s, bool damped) {
  if (low.piece != high.piece) return Event::Kind::contact;
  if (s.imag() == 0) return Event::Kind::divergence;
  return damped ? Event::Kind::crossing : Event::Kind::coalescence;
}

}  // namespace

void addUnlocatedChanges(TrackedLine& line) {
  const auto& stations = line.branches.stations;
  std::vector<Critical> found;
  for (std::size_t k = 1; k < stations.size(); ++k) {
    const Station &low = stations[k - 1], &high = stations[k];
    if (low.friction < line.from) continue;  // another active set applies there
    const bool isLoss = isUnstable(high, line.isDamped);
    if (isUnstable(low, line.isDamped) == isLoss) continue;
    const auto* pair =
        isLoss ? changed(high, low, line.isDamped) : changed(low, high, line.isDamped);
    const auto explains = [&](const Critical& known) {
      return known.loss == isLoss && known.friction + known.errorEstimate >= low.friction &&
             known.friction - known.errorEstimate <= high.friction;
    };
    if (!pair || std::ranges::any_of(line.criticals, explains)) continue;
    const auto kind = kindOf(low, high, pair->s, line.isDamped);
    found.push_back({.kind = kind,
                     .partner = 0,
                     .friction = 0.5 * (low.friction + high.friction),
                     .angularFrequency = pair->s.imag(),
                     .loss = isLoss,
                     .errorEstimate = 0.5 * (high.friction - low.friction),
                     .converged = low.friction == high.friction,
                     .piece = high.piece});
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
