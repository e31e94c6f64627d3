// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Changes of stability at frictions that tracking has not located.
#include "eigen/stability/followed.hpp"

namespace squeal::stability {

/// Adds a critical friction that is not converged for each step from a station where all
/// eigenvalues of the band are stable to one with an unstable eigenvalue, or the reverse, if no
/// critical friction with this direction is known in the step: where eigenvalues could not be
/// matched, or where no basis serves both stations. Its friction is the middle of the step. An
/// unstable eigenvalue that only crosses the edge of the band changes nothing.
void addUnlocatedChanges(TrackedLine& line);

}  // namespace squeal::stability
