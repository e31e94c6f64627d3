// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Serialisation of steady states for checkpoints.
#include "base/checkpoint/archive.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::steady {

/// Collective. Writes or reads a steady state.
void serialise(checkpoint::Archive& archive, Solution& solution);

}  // namespace squeal::steady
