// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Continuation of a branch of periodic motions over the friction, through folds, at which the
/// branch turns back and its motions lose or regain stability [M.78].
#include <functional>
#include <string>
#include <vector>

#include "regime/cycles/shooting.hpp"

namespace squeal::cycles {

struct ContinuationLimits {
  double lowest = 0, highest = 0;  ///< friction
  int most = 0;                    ///< number of motions in each direction
  double tolerance = 0;            ///< of shoot()
};

/// A branch in one direction.
struct Route {
  std::vector<double> folds;  ///< frictions at which the branch turns back, interpolated
  double end = 0;             ///< friction at its end
  std::string reason;         ///< of its end
};

/// Collective. Follows the branch through a converged periodic motion by pseudo-arclength
/// continuation, first towards larger friction if `upwards`. The step is adaptive, and halved if
/// Newton's method fails. It calls `inspect` for each motion found, except the first.
Route continueBranch(const Period& period, const ShootingResult& first, bool upwards,
                     const ContinuationLimits& limits, const Progress& progress,
                     const std::function<void(const ShootingResult&)>& inspect);

}  // namespace squeal::cycles
