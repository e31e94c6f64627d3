#include "eigen/pencil/band.hpp"

#include <algorithm>
#include <cmath>

#include "base/options/options.hpp"

namespace squeal::pencil {
namespace {

const RealOption bandOption(
    "flutter", "flutter_band", 0, "Hz", nonNegative,
    "|s|/(2 pi), for little damping the frequency, up to which eigenvalues "
    "are corrected and listed, as far as "
    "the free modes of the active set reach; 0: that of the free mode 0.55 up their list");
const RealOption bandDampingOption(
    "flutter", "flutter_band_damping", 0.5, "", positive,
    "eigenvalues of a larger damping ratio, which die away within a cycle, are not listed");

}  // namespace

double bandAsked() { return 2 * M_PI * bandOption.get(); }

double bandBelow(const std::vector<double>& w) {
  constexpr double apart = 1 + 1e-4;
  // The edge lies between two modes of different frequency, so that rounding does not decide
  // whether an eigenvalue is inside. The last mode may be one of an equal pair whose other mode is
  // not in the list.
  const auto edge = [&](std::size_t k) {
    return k > 0 && w[k] >= apart * w[k - 1];
  };  // below mode k
  const auto middle = [&](std::size_t k) {
    return k > 0 ? 0.5 * (w[k - 1] + w[k]) : apart * w.back();
  };
  std::size_t last = w.size() - 1;
  while (last > 0 && !edge(last)) --last;
  if (const double asked = bandAsked(); asked > 0) return std::min(asked, middle(last));
  std::size_t k = std::min(w.size() * 11 / 20 + 1, last);
  while (k < last && !edge(k)) ++k;
  return middle(k);
}

WatchedBand bandFor(const std::vector<double>& frequencies) {
  WatchedBand band;
  band.top = bandBelow(frequencies);
  band.damping = bandDampingOption.get();
  return band;
}

}  // namespace squeal::pencil
