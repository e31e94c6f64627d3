// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The marches of one point of the sweep: their starts, steps and times, and the bounds on these
/// [§ 17].
#include <span>
#include <string>
#include <vector>

#include "regime/march/onset.hpp"
#include "regime/regime/settings.hpp"

namespace squeal::regime {

using march::LinearMode;
using march::Onset;
using march::ReducedModel;

/// A planned march.
struct Task {
  std::string start = {};  ///< the number of the unstable mode, or "all"
  LinearMode mode = {};    ///< scaled to its onset
  Onset onset = {};
  double shortestPeriod = 0;  ///< of its modes, s
  double step = 0, time = 0;  ///< s
  std::string failure = {};   ///< the reason to omit it; empty: none
};

/// An unstable mode of the reduced model.
struct NumberedMode {
  std::size_t number = 0;  ///< among the eigenvalues of the point, from 1
  LinearMode mode;
};

/// Throws Error if step and time are given and need more steps than a march may have.
void checkSteps(const MarchSettings& settings);

/// Returns the names of the starts on modes of these numbers, the fastest growing one first.
std::vector<std::string> startsOn(std::span<const std::size_t> numbers, Starts starts);

/// Not collective. Returns the marches that start on these modes, the fastest growing one first.
/// `stableStep` is that of the model with all nodes held, s. Sets the failure of a march whose mode
/// does not oscillate or never separates or sticks, or whose step or time violates a bound.
std::vector<Task> tasksOn(const ReducedModel& model, const MarchSettings& settings,
                          std::span<const NumberedMode> modes, double stableStep);

}  // namespace squeal::regime
