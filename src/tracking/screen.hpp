#pragma once
/// Changes of stability that come and go within a step: stable at both ends, unstable in between,
/// or the reverse.
#include "linalg/dense.hpp"
#include "tracking/track.hpp"

namespace squeal::tracking {

/// An eigenvalue known by itself at both ends of a step.
struct Pursued {
  int branch = 0;
  linalg::DensePair below, above;
  double isolation = 0;
};

struct StepEnd {
  double friction;
  const linalg::DenseProblem& problem;
};

/// Collective. Slopes at both ends say, by a cubic through each step, which two neutral eigenvalues
/// may meet and which growth may change its sign twice; these are examined in between by their own
/// subspace. Found are mergers wider than about 1e-5 of the step, and arches of the growth that the
/// cubic shows to within a tenth. What cannot be examined becomes a gap.
void screen(Family& family, const StepEnd& low, const StepEnd& high,
            const std::vector<Pursued>& singles, std::vector<Event>& events,
            std::vector<Gap>& gaps);

}  // namespace squeal::tracking
