// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The planned time integrations of one point of the sweep: their starts, time steps and durations,
/// and the bounds on these [§ 17].
#include <span>
#include <string>
#include <vector>

#include "regime/march/onset.hpp"
#include "regime/regime/settings.hpp"

namespace squeal::regime {

using march::LinearMode;
using march::Onset;
using march::ReducedModel;

/// A planned time integration.
struct Task {
  std::string start = {};  ///< the number of the unstable mode, or "all"
  LinearMode mode = {};    ///< scaled to the amplitude of its onset
  Onset onset = {};
  double shortestPeriod = 0;  ///< shortest period of its modes, s
  double step = 0, time = 0;  ///< time step and maximum time, s
  std::string failure = {};   ///< why it is omitted or has failed; empty: no failure
};

/// An unstable mode of the reduced model.
struct NumberedMode {
  std::size_t number = 0;  ///< number among the eigenvalues of the point, from 1
  LinearMode mode;
};

/// Throws Error if both time and step are given and time / step exceeds the largest number of
/// steps.
void checkSteps(const MarchSettings& settings);

/// Returns the names of the starts on the modes with these numbers. The numbers must be ordered by
/// growth rate, the fastest growing mode first.
std::vector<std::string> startsOn(std::span<const std::size_t> numbers, Starts starts);

/// Not collective. Returns the time integrations that start on these modes, which must be ordered
/// with the fastest growing one first. `stableStep` is the stable step of the model with all nodes
/// held, s. Sets Task::failure if the mode does not oscillate, if it makes no node separate, stick
/// or slide, if a sticking node is already at its friction limit, or if the step or the time
/// violates a bound.
std::vector<Task> tasksOn(const ReducedModel& model, const MarchSettings& settings,
                          std::span<const NumberedMode> modes, double stableStep);

}  // namespace squeal::regime
