// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A solved point of a sweep.
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/reduction/point_state.hpp"
#include "eigen/sweep_solver/sweep_plan.hpp"

namespace squeal::sweep_solver {

/// A solved point.
struct ListedPoint {
  PointPlace place;
  reduction::PointProblem problem;  ///< with all terms
  pencil::ComplexModes* list;       ///< borrowed
};

}  // namespace squeal::sweep_solver
