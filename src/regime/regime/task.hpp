#pragma once
/// The marches that one point of the sweep asks for: where each starts, its step and its time, and
/// the bounds that these must keep [§ 17].
#include <span>
#include <string>
#include <vector>

#include "regime/march/onset.hpp"
#include "regime/regime/settings.hpp"

namespace squeal::regime {

using march::LinearMode;
using march::Onset;
using march::ReducedModel;

/// A march to be done.
struct Task {
  std::string start;  ///< the number of the unstable mode, or "all"
  LinearMode mode;    ///< scaled to its onset
  Onset onset;
  double shortestPeriod = 0;  ///< of the modes that it starts on, s
  double step = 0, time = 0;  ///< s
  std::string failure;        ///< why it cannot be done; empty: it can
};

/// An unstable mode of the reduced model.
struct NumberedMode {
  std::size_t number = 0;  ///< among the eigenvalues of the point, from 1
  LinearMode mode;
};

/// Throws Error if step and time are given and take more steps than a march may have.
void checkSteps(const MarchSettings& settings);

/// Returns the names of the starts that are wanted on modes of these numbers, the fastest growing
/// one first.
std::vector<std::string> startsOn(std::span<const std::size_t> numbers, Starts starts);

/// Not collective. Returns the marches that start on these modes, the fastest growing one first.
/// `stableStep` is that of the model with all nodes held, s. A march that cannot be done has its
/// failure set: its mode does not oscillate or meets no limit of the contact, its step or its time
/// breaks a bound.
std::vector<Task> tasksOn(const ReducedModel& model, const MarchSettings& settings,
                          std::span<const NumberedMode> modes, double stableStep);

}  // namespace squeal::regime
