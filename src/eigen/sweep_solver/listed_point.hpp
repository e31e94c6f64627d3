// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A solved point of a sweep.
#include <cstddef>

#include "eigen/pencil/complex_modes.hpp"
#include "eigen/reduction/point_state.hpp"

namespace squeal::sweep_solver {

/// A solved point.
struct ListedPoint {
  std::size_t range;                ///< index in SweepProblem::ranges
  reduction::PointProblem problem;  ///< with all terms
  pencil::ComplexModes* list;       ///< borrowed
};

}  // namespace squeal::sweep_solver
