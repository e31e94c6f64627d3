// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Free modes on their way to and from a checkpoint.
#include "base/checkpoint/archive.hpp"
#include "eigen/modes/modes.hpp"

namespace squeal::modes {

/// Collective. Writes the modes, or sets them to those of the archive, with vectors laid out like
/// the columns of `like`. While it is written from, the archive borrows the vectors.
void exchange(checkpoint::Archive& archive, Modes& modes, Mat like);

}  // namespace squeal::modes
