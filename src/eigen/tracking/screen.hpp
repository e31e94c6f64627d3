// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Search for stability changes within one step that the signs of the growth rates at its ends do
/// not show.
#include "algebra/linalg/quadratic.hpp"
#include "eigen/tracking/neutral_end.hpp"
#include "eigen/tracking/track.hpp"

namespace squeal::tracking {

/// An eigenvalue that is joined over a step by itself, not in a group.
struct ContinuedPair {
  int branch = 0;
  linalg::DensePair below, above;  ///< at the lower and at the upper end
  double isolation = 0;            ///< distance from other eigenvalues, rad/s
};

/// Collective. Appends the events that are found within the step between `low` and `high`. A cubic
/// through the values and slopes at both ends selects candidates: pairs of neutral eigenvalues that
/// may meet, growth rates that may change sign twice, and eigenvalues that are neutral at one end
/// and whose growth rate has another sign near it than at the other end. The candidates are
/// examined within the step, in their own subspace. This finds mergers wider than about 1e-5 of the
/// step. It also finds double sign changes of a growth rate if its cubic falls below a tenth of the
/// smaller value at the ends. Removes an event at a neutral end that an event within the step
/// replaces. If an examination fails or is undecided, appends a gap.
void screen(Family& family, const StepEnd& low, const StepEnd& high,
            const std::vector<ContinuedPair>& singles, std::vector<Event>& events,
            std::vector<Gap>& gaps);

}  // namespace squeal::tracking
