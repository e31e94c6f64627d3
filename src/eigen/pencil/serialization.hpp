// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Complex modes on their way to and from a checkpoint.
#include "base/checkpoint/archive.hpp"
#include "eigen/pencil/complex_modes.hpp"

namespace squeal::pencil {

/// Collective. Writes what was found at a point, or sets it.
void exchange(checkpoint::Archive& archive, ComplexModes& point);

}  // namespace squeal::pencil
