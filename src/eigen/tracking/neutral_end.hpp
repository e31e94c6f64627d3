// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// In a damped system, an eigenvalue that is neutral at one end of a step between two frictions: it
/// neither grows nor decays there. At friction 0 all are neutral if only friction damps the system.
/// The slope of the eigenvalue gives the sign of its growth rate near that end, which may differ
/// from the sign at the other end.
#include <functional>
#include <optional>
#include <vector>

#include "eigen/tracking/track.hpp"

namespace squeal::tracking {

/// An eigenvalue over a step with an end where it is neutral.
struct NeutralStep {
  /// The branch, the ends of the step, the pairs there, and their distance to other eigenvalues.
  Event event;
  double slopeBelow, slopeAbove;  ///< d Re s/df at the lower and at the upper end, 1/s
  /// Collective. Returns the pair at a friction of the step; empty if it is not found.
  std::function<std::vector<linalg::DensePair>(double)> pairAt;
};

/// Returns true if the sign of the growth rate near the neutral end differs from that at the other
/// end. (The function crossing() compares only the ends and misses this change.) Returns false if
/// neither or both ends are neutral, or if the eigenvalue is real at an end.
bool changesSignWithin(const NeutralStep& step);

/// Collective. Returns the changes of stability of a step for which changesSignWithin() holds: one
/// within the step, and one at the neutral end if the eigenvalue grows near it. Returns nullopt if
/// the sign near the neutral end cannot be confirmed.
std::optional<std::vector<Event>> changesOf(const NeutralStep& step);

/// Collective. Brackets each change of stability of a single eigenvalue that is placed at a neutral
/// end, by the signs of the growth rates at the stations around it. An eigenvalue counts as neutral
/// within 1e-10 |s| of the imaginary axis (join.hpp), so one that moves slowly may be neutral at
/// several stations, and cross the axis away from the last of them. Growth rates within round-off
/// of zero leave the change where it is. A loss and a regain are omitted if the growth rate stays
/// positive between them.
void bracketNeutralEnds(const std::vector<Piece>& path, Branches& branches);

/// One end of a step.
struct StepEnd {
  double friction;
  const linalg::DenseProblem& problem;
};

/// Collective. Returns the slopes ds/df of the eigenvalues in `spectrum`, which belongs to the
/// problem at `low` or at `high`. The derivative of P with respect to f is approximated by the
/// difference of these two problems, divided by that of their frictions. This is exact where P is
/// linear in f, and elsewhere good enough to select the steps to examine. The result is the same on
/// all ranks.
std::vector<Complex> slopes(MPI_Comm comm, const linalg::Spectrum& spectrum, const StepEnd& low,
                            const StepEnd& high);

}  // namespace squeal::tracking
