// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sensitivity/settings.hpp"

#include "base/options/options.hpp"

namespace squeal::sensitivity {
namespace {

const FlagOption wantedOption(
    "flutter", "flutter_sensitivities", false,
    "derivatives with respect to friction, speed, pressure, moduli, densities, damping of bodies, "
    "springs, bushings and masses; sensitivities.csv: of the eigenvalues of the stored complex "
    "modes (-flutter_shapes); critical_sensitivities.csv: of the critical frictions");

}  // namespace

Settings Settings::given() { return {.wanted = wantedOption.get()}; }

}  // namespace squeal::sensitivity
