// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The lines of a sweep, along which eigenvalues are tracked.
#include <functional>
#include <vector>

#include "eigen/sweep_solver/results.hpp"
#include "eigen/sweep_solver/settings.hpp"
#include "eigen/sweep_solver/sweep_plan.hpp"

namespace squeal::sweep_solver {

/// Returns the problem of a range of points, by its index in SweepProblem::ranges.
using SourceOfRange = std::function<tracking::ProblemSource(std::size_t)>;

struct LineOfSegment {
  stability::Line line;
  std::size_t segment;  ///< index in SweepState::segments of the first point with results here
};

/// Returns the lines of a sweep. They borrow the modes of `state`.
std::vector<LineOfSegment> linesOf(const SweepProblem& problem, const SweepPlan& plan,
                                   const SweepState& state, const SourceOfRange& sourceOf);

/// Collective. Tracks eigenvalues along lines, and returns for each line its branches and critical
/// frictions with their modes. Throws Interrupted once a stop has been requested.
std::vector<stability::TrackedLine> trackedLines(SweepProblem& problem,
                                                 reduction::ReducedProblem& reduced,
                                                 const std::vector<stability::Line>& lines,
                                                 const Settings& settings);

/// Moves the tracked lines of segments without results to another segment.
void keepTrackedLines(std::vector<ModalSegment>& segments);

}  // namespace squeal::sweep_solver
