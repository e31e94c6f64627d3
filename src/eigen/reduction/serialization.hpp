// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Serialisation of the solutions of points for checkpoints.
#include "base/checkpoint/archive.hpp"
#include "eigen/reduction/point_state.hpp"

namespace squeal::reduction {

/// Not collective. Writes or reads the solution of a point, which is the same on all ranks.
void fields(Stream& stream, PointSolution& solution);

}  // namespace squeal::reduction
