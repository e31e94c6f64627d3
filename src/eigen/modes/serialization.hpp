// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Serialisation of free modes for checkpoints.
#include "base/checkpoint/archive.hpp"
#include "eigen/modes/modes.hpp"

namespace squeal::modes {

/// Collective. Writes or reads the modes. Their vectors have the layout of the columns of `like`,
/// and an archive that is being written borrows them.
void serialise(checkpoint::Archive& archive, Modes& modes, Mat like);

}  // namespace squeal::modes
