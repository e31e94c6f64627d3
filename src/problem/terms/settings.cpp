// SPDX-License-Identifier: BSD-2-Clause
#include "problem/terms/settings.hpp"

#include "base/options/option_types.hpp"

namespace squeal::terms {
namespace {

const FlagOption dampingOption(
    "flutter", "flutter_friction_damping", true,
    "friction-induced damping, and stiffness with convective terms: the friction force turns with "
    "the relative velocity and follows the friction law");

}  // namespace

Settings Settings::given() { return {.frictionDamping = dampingOption.get()}; }

}  // namespace squeal::terms
