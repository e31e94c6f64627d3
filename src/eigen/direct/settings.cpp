// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/direct/settings.hpp"

#include <cmath>
#include <vector>

#include "base/options/options.hpp"
#include "base/system/error.hpp"

namespace squeal::direct {
namespace {

const IntegerOption countOption("flutter", "flutter_direct_count", 100, 1, 1'000'000,
                                "number of eigenvalues nearest to zero for the direct method, with "
                                "conjugate pairs counted once");
const RealListOption bandOption(
    "flutter", "flutter_direct_band", "0,0", "Hz", nonNegative,
    "low,high: band of the direct method, low <= Im s / 2 pi <= high and |s| <= 2 pi high, instead "
    "of a number of eigenvalues; 0,0 = off");
const IntegerOption limitOption(
    "flutter", "flutter_direct_limit", 2000, 1, 1'000'000,
    "largest number of eigenvalues for -flutter_direct_band, direct method only");
const FlagOption confirmOption(
    "flutter", "flutter_direct_confirm", true,
    "repetition of the direct solve from other start vectors until no new eigenvalue is found: a "
    "single solve may miss multiple eigenvalues");

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
