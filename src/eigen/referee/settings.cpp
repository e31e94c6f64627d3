// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/referee/settings.hpp"

#include <cmath>

#include "base/options/options.hpp"
#include "base/system/error.hpp"

namespace squeal::referee {
namespace {

const RealOption topOption(
    "referee", "referee_top", 0, "Hz", nonNegative,
    "top (in Hz) of the region |s| < 2 pi top that the referee judges, moved into a gap between "
    "eigenvalues at most 8 % away; 0 = automatic (the first gap above the list)");
const RealOption leftOption(
    "referee", "referee_left", 0, "", Range{0, 1},
    "distance by which the judged region of a damped problem reaches to the left of the imaginary "
    "axis, as a fraction of its top; 0 = automatic (as far as the most damped entry of the list, "
    "between 0.02 and 0.2)");
const RealOption toleranceOption("referee", "referee_tolerance", 1e-4, "", Range{1e-12, 0.1},
                                 "largest distance |ds|/|s| from a proved eigenvalue at which an "
                                 "entry of the list is right; an entry farther away is inexact");
const IntegerOption discsOption(
    "referee", "referee_discs", 400, 1, 100'000,
    "largest number of discs in the complex plane that cover the boundary of the judged region");

}  // namespace

Settings Settings::given() {
  return {
      .top = 2 * M_PI * topOption.get(),
      .left = leftOption.get(),
      .tolerance = toleranceOption.get(),
      .discs = discsOption.get(),
      .remedies = {"-modes_count", topOption.dashed(), leftOption.dashed(), discsOption.dashed()}};
}

void rejectWithout(const std::string& needed) {
  for (const Option* option : std::initializer_list<const Option*>{&topOption, &leftOption,
                                                                   &toleranceOption, &discsOption})
    if (option->given()) throw Error("option " + option->dashed() + " needs " + needed);
}

}  // namespace squeal::referee
