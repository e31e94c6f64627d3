// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/pencil/band.hpp"

#include <algorithm>
#include <cmath>

namespace squeal::pencil {
double bandBelow(const std::vector<double>& w, double requested) {
  constexpr double apart = 1 + 1e-4;
  // The edge lies between two modes of different frequency, so round-off does not decide whether an
  // eigenvalue is inside. The last mode may belong to an equal pair whose other mode is not in the
  // list.
  const auto edge = [&](std::size_t k) {
    return k > 0 && w[k] >= apart * w[k - 1];
  };  // below mode k
  const auto middle = [&](std::size_t k) {
    return k > 0 ? 0.5 * (w[k - 1] + w[k]) : apart * w.back();
  };
  std::size_t last = w.size() - 1;
  while (last > 0 && !edge(last)) --last;
  if (requested > 0) return std::min(requested, middle(last));
  std::size_t k = std::min(w.size() * 11 / 20 + 1, last);
  while (k < last && !edge(k)) ++k;
  return middle(k);
}

WatchedBand bandFor(const std::vector<double>& frequencies, const BandLimits& limits) {
  WatchedBand band;
  band.top = bandBelow(frequencies, limits.top);
  band.damping = limits.damping;
  return band;
}

}  // namespace squeal::pencil
