// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Search for pairs of stability changes within one step: stable at both ends and unstable in
/// between, or the reverse.
#include "algebra/linalg/quadratic.hpp"
#include "eigen/tracking/track.hpp"

namespace squeal::tracking {

/// An eigenvalue that is joined over a step by itself, not in a group.
struct ContinuedPair {
  int branch = 0;
  linalg::DensePair below, above;  ///< at the lower and at the upper end
  double isolation = 0;            ///< distance from other eigenvalues, rad/s
};

/// One end of a step.
struct StepEnd {
  double friction;
  const linalg::DenseProblem& problem;
};

/// Collective. Appends the events that are found within the step between `low` and `high`. A cubic
/// through the values and slopes at both ends selects candidates: pairs of neutral eigenvalues that
/// may meet, and growth rates that may change sign twice. The candidates are examined within the
/// step, in their own subspace. This finds mergers wider than about 1e-5 of the step. It also finds
/// double sign changes of a growth rate if its cubic falls below a tenth of the smaller value at
/// the ends. If an examination fails or is undecided, appends a gap.
void screen(Family& family, const StepEnd& low, const StepEnd& high,
            const std::vector<ContinuedPair>& singles, std::vector<Event>& events,
            std::vector<Gap>& gaps);

}  // namespace squeal::tracking
