// SPDX-License-Identifier: BSD-2-Clause
#include "problem/terms/settings.hpp"

#include "base/options/option_types.hpp"

namespace squeal::terms {
namespace {

const FlagOption dampingOption(
    "flutter", "flutter_friction_damping", true,
    "friction damping: during a vibration the friction force turns with the relative velocity and "
    "follows the friction law, which with convective terms also changes the stiffness; off: the "
    "friction force keeps the direction of steady sliding and follows only the normal force");

}  // namespace

Settings Settings::given() { return {.frictionDamping = dampingOption.get()}; }

}  // namespace squeal::terms
