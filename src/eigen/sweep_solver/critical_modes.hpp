// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The modes at the critical frictions of a tracked line.
#include <functional>
#include <string>

#include "eigen/reduction/reduced.hpp"
#include "eigen/stability/followed.hpp"
#include "eigen/sweep_solver/sweep_problem.hpp"

namespace squeal::sweep_solver {

/// Collective. Adds to a tracked line the mode at each critical friction that is a converged root
/// with a nonzero slope: its name, the shares of the free modes in it and, if `derives`, the
/// derivatives of the critical friction. Calls `progress`, which may throw, before it computes the
/// derivatives of a critical friction.
void addCriticalModes(SweepProblem& problem, reduction::ReducedProblem& reduced,
                      const stability::Line& line, bool derives,
                      const std::function<void(const std::string&)>& progress,
                      stability::TrackedLine& tracked);

}  // namespace squeal::sweep_solver
