// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Pairs of changes of stability within one step: stable at both ends and unstable in between, or
/// the reverse.
#include "algebra/linalg/quadratic.hpp"
#include "eigen/tracking/track.hpp"

namespace squeal::tracking {

/// An eigenvalue that is joined by itself over a step.
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

/// Collective. Appends the events found within the step between `low` and `high`. A cubic through
/// the values and slopes at both ends shows which two neutral eigenvalues may meet and which growth
/// rate may change its sign twice. These are examined in between by their own subspace. Mergers
/// wider than about 1e-5 of the step are found, and so are arches of the growth rate whose cubic
/// falls to a tenth of the values at the ends. If an examination fails or does not decide, a gap is
/// appended.
void screen(Family& family, const StepEnd& low, const StepEnd& high,
            const std::vector<ContinuedPair>& singles, std::vector<Event>& events,
            std::vector<Gap>& gaps);

}  // namespace squeal::tracking
