// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Steady states on their way to and from a checkpoint.
#include "base/checkpoint/archive.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::steady {

/// Collective. Writes a steady state, or sets it.
void exchange(checkpoint::Archive& archive, Solution& solution);

}  // namespace squeal::steady
