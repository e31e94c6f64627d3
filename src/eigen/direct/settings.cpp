// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/direct/settings.hpp"

#include <cmath>
#include <vector>

#include "base/options/options.hpp"
#include "base/system/error.hpp"

namespace squeal::direct {
namespace {

const IntegerOption countOption("flutter", "flutter_direct_count", 100, 1, 1'000'000,
                                "number of eigenvalues nearest to zero that the direct method "
                                "computes; a conjugate pair counts once");
const RealListOption bandOption(
    "flutter", "flutter_direct_band", "0,0", "Hz", nonNegative,
    "low,high: frequency band of the direct method, instead of a number of eigenvalues: low <= Im "
    "s / 2 pi <= high and |s| <= 2 pi high; 0,0 = off");
const IntegerOption limitOption(
    "flutter", "flutter_direct_limit", 2000, 1, 1'000'000,
    "largest number of eigenvalues that the direct method computes for -flutter_direct_band");
const FlagOption confirmOption(
    "flutter", "flutter_direct_confirm", true,
    "repetition of the direct solve from other start vectors until no new eigenvalue is found, "
    "since a single solve may miss multiple eigenvalues");

}  // namespace

Settings Settings::given(const pencil::Settings& problem) {
  const auto band = bandOption.get();
  const bool off = band == std::vector<double>{0, 0};
  if (band.size() != 2 || (!off && band[0] >= band[1]))
    throw Error("option " + bandOption.dashed() + ": two frequencies, the lower one first");
  return {.count = countOption.get(),
          .limit = limitOption.get(),
          .low = 2 * M_PI * band[0],
          .high = 2 * M_PI * band[1],
          .confirmed = confirmOption.get(),
          .criteria = problem.criteria};
}

}  // namespace squeal::direct
