#pragma once
/// A branch of periodic motions is followed over the friction, through folds, where the branch
/// turns back and its motions lose or regain stability [M.78].
#include <functional>
#include <string>
#include <vector>

#include "regime/cycles/shooting.hpp"

namespace squeal::cycles {

/// Where and how far a branch is followed.
struct Reach {
  double lowest = 0, highest = 0;  ///< friction
  int most = 0;                    ///< motions in each direction
  double tolerance = 0;            ///< of shoot()
};

/// How a branch goes on from a motion.
struct Way {
  std::vector<double> folds;  ///< frictions at which the branch turns back, interpolated
  double end = 0;             ///< friction at which it ends
  std::string reason;         ///< why it ends there
};

/// Collective. Follows the branch through a periodic motion that has converged by pseudo-arclength,
/// first towards larger friction if `upwards`. The step adapts itself: it is halved where Newton's
/// method fails. `look` is called for each motion found, without the first.
Way follow(Period& period, const Found& first, bool upwards, const Reach& reach, const Told& told,
           const std::function<void(const Found&)>& look);

}  // namespace squeal::cycles
