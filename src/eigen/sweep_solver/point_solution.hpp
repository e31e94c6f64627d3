// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The solution of points of a sweep.
#include <functional>
#include <string>
#include <vector>

#include "eigen/pencil/complex_modes.hpp"
#include "eigen/reduction/reduced.hpp"
#include "eigen/sweep_solver/settings.hpp"

namespace squeal::sweep_solver {

/// Collective. Solves points by the reduced problem, or directly if it is null. `trial` maps the
/// unknowns to the reported vectors. Throws Error on failure, or if an eigenvalue is not finite.
std::vector<pencil::ComplexModes> solvedPoints(reduction::ReducedProblem* reduced,
                                               const std::vector<reduction::PointProblem>& problems,
                                               Mat trial, const Settings& settings);

/// Returns the points of a batch that belong to `points`, in the order of the batch.
std::vector<std::size_t> commonPoints(const std::vector<std::size_t>& batch,
                                      const std::vector<std::size_t>& points);

/// Collective. Clears these solved points and calls `solve` to solve them again. A point without a
/// new result gets its old one back. Returns the message if `solve` throws Error; otherwise an
/// empty text.
std::string solveAgain(const std::vector<pencil::ComplexModes*>& points,
                       const std::function<void()>& solve);

}  // namespace squeal::sweep_solver
