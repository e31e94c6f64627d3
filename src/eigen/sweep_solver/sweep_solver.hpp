// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The algebraic part of the method, from K0, M0 and the terms of the pencil to the eigenvalues of
/// a sweep. It is the same for a mesh and for matrix files.
#include <string>
#include <vector>

#include "base/checkpoint/checkpoint.hpp"
#include "eigen/sweep_solver/results.hpp"
#include "eigen/sweep_solver/settings.hpp"
#include "eigen/sweep_solver/sweep_problem.hpp"

namespace squeal::sweep_solver {

/// The requested sweep.
struct Request {
  Settings settings;
  std::vector<double> dampings;  ///< damping factors, solved for at each steady point
  int reportedModes = 0;         ///< number of free modes whose shapes are reported
};

/// Collective. Returns a segment of results for each range of steady points with one active set:
/// the free modes, the eigenvalues at these points with all dampings, and the eigenvalues tracked
/// as the friction changes. Restores and continues the checkpoint logs whose names begin with
/// `name`. If a point or a stage fails, the others are still computed, and the result contains the
/// reason. Throws Error if no point is solved.
SolvedSweep solveSweep(SweepProblem& problem, const Request& request,
                       checkpoint::Checkpoint& checkpoint, const std::string& name);

}  // namespace squeal::sweep_solver
