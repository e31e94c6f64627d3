// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The number of steady states at each speed of a sweep.
#include <vector>

#include "run/analysis/steady_sweep.hpp"
#include "steady/uniqueness/uniqueness.hpp"

namespace squeal::analysis {

/// The results on the number of steady states at one speed, for all frictions.
struct SpeedUniqueness {
  double speed = 1;  ///< v
  uniqueness::Uniqueness found;
};

/// Results of `-steady_uniqueness`.
struct UniquenessStudy {
  /// One entry per speed, or a single one if the result is the same at all speeds; empty without
  /// contact or without the option.
  std::vector<SpeedUniqueness> speeds;
  bool complete = true;  ///< false if a request to stop ended the computation
};

/// Collective. Examines uniqueness at each speed, or only once if the stiffness and the slip are
/// the same at all speeds. Loads have no influence on the result. Throws Error as
/// uniqueness::examine() does.
UniquenessStudy examineUniqueness(const Model& model, const sweep::Sweep& sweep,
                                  const uniqueness::Settings& settings);

}  // namespace squeal::analysis
