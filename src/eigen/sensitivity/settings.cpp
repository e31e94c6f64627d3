// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sensitivity/settings.hpp"

#include "base/options/options.hpp"

namespace squeal::sensitivity {
namespace {

const FlagOption wantedOption(
    "flutter", "flutter_sensitivities", false,
    "derivatives with respect to friction, speed, pressure, damping, moduli and densities of "
    "bodies, stiffness of springs and bushings, and point masses; sensitivities.csv contains those "
    "of the eigenvalues of stored complex modes (-flutter_shapes), critical_sensitivities.csv "
    "those of critical frictions");

}  // namespace

Settings Settings::given() { return {.wanted = wantedOption.get()}; }

}  // namespace squeal::sensitivity
