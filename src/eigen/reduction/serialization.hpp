// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Solutions of points on their way to and from a checkpoint.
#include "base/checkpoint/archive.hpp"
#include "eigen/reduction/point_state.hpp"

namespace squeal::reduction {

/// Not collective. Writes the solution of a point, the same on all ranks, or sets it.
void fields(Stream& stream, PointSolution& solution);

}  // namespace squeal::reduction
