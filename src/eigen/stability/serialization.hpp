// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Serialisation of tracked eigenvalues for checkpoints.
#include "algebra/linalg/serialization.hpp"
#include "base/checkpoint/archive.hpp"
#include "eigen/stability/followed.hpp"

namespace squeal::stability {

/// Not collective. Writes or reads the tracked eigenvalues of a line, which are the same on all
/// ranks.
void fields(Stream& stream, TrackedLine& tracked);

}  // namespace squeal::stability
