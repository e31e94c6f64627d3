// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Steps of a tracked line in which something happens at a friction that is not known.
#include <utility>
#include <vector>

#include "eigen/stability/followed.hpp"

namespace squeal::stability {

/// Returns the frictions between which the active set changes, without a piece of the path that
/// begins or ends at the change.
std::vector<std::pair<double, double>> directJumps(const tracking::Branches& branches);

/// Adds a critical friction that is not converged for each step from a station where all
/// eigenvalues of the band are stable to one with an unstable eigenvalue, or the reverse, if no
/// critical friction in this step is known: where eigenvalues could not be matched, or where no
/// basis serves both stations. Its friction is the middle of the step.
void addUnlocatedChanges(TrackedLine& line);

}  // namespace squeal::stability
