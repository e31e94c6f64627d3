// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The algebraic part of the method leads from K0, M0 and the terms of the pencil to the
/// eigenvalues of a sweep. It is the same for a mesh and for matrices from files.
#include <string>
#include <vector>

#include "base/checkpoint/checkpoint.hpp"
#include "eigen/sweep_solver/results.hpp"
#include "eigen/sweep_solver/settings.hpp"
#include "eigen/sweep_solver/sweep_problem.hpp"

namespace squeal::sweep_solver {

/// The sweep that is asked for.
struct Request {
  Settings settings;
  std::vector<double> dampings;  ///< swept at all steady points
  int reportedModes = 0;         ///< number of free modes whose shapes are reported
};

/// Collective. Returns for each range of points their modes, their eigenvalues at all steady points
/// with all dampings, and the eigenvalues followed over the friction. Entries of the logs of the
/// checkpoint whose names begin with `name` are restored, and the logs are continued. A point or a
/// stage that fails does not affect the other points: the reasons are returned. The terms of the
/// problem's ranges are taken. Throws Error if no point is solved.
SolvedSweep solveSweep(SweepProblem& problem, const Request& request,
                       checkpoint::Checkpoint& checkpoint, const std::string& name);

}  // namespace squeal::sweep_solver
