// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The number of steady states at each speed of a sweep.
#include <vector>

#include "run/analysis/steady_sweep.hpp"
#include "steady/uniqueness/uniqueness.hpp"

namespace squeal::analysis {

/// The number of steady states at one speed, for all frictions, as far as it is known.
struct SpeedUniqueness {
  double speed = 1;  ///< v
  uniqueness::Uniqueness found;
};

/// Results of `-steady_uniqueness`.
struct UniquenessStudy {
  /// One entry for all speeds where they share it; empty without contact or without the option.
  std::vector<SpeedUniqueness> speeds;
  bool complete = true;  ///< false if the run has been asked to stop
};

/// Collective. Examines uniqueness at each speed, or once if K and the slip are the same at all
/// speeds; loads do not matter. Throws Error as uniqueness::examine() does.
UniquenessStudy examineUniqueness(const Model& model, const sweep::Sweep& sweep,
                                  const uniqueness::Settings& settings);

}  // namespace squeal::analysis
