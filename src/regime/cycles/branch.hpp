// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Continuation of a branch of periodic motions with friction as the parameter [M.78]. It passes
/// through folds, where the branch turns back and its motions lose or regain stability.
#include <functional>
#include <string>
#include <vector>

#include "regime/cycles/shooting.hpp"

namespace squeal::cycles {

struct ContinuationLimits {
  double lowest = 0, highest = 0;  ///< range of frictions
  int most = 0;                    ///< largest number of motions in each direction
  double tolerance = 0;            ///< tolerance of shoot()
};

/// The part of a branch that was followed in one direction.
struct Route {
  std::vector<double> folds;  ///< frictions at which the branch turns back, interpolated
  double end = 0;             ///< friction at its end
  std::string reason;         ///< why it ends there
};

/// Collective. Follows the branch that contains the converged periodic motion `first`, by
/// pseudo-arclength continuation. It starts towards larger friction if `upwards`, otherwise towards
/// smaller. The step length is adaptive, and is halved if Newton's method fails. Calls `inspect`
/// for each further motion that is found.
Route continueBranch(const Period& period, const ShootingResult& first, bool upwards,
                     const ContinuationLimits& limits, const Progress& progress,
                     const std::function<void(const ShootingResult&)>& inspect);

}  // namespace squeal::cycles
