// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// One step of the continuation of eigenvalues, between two stations.
#include <optional>
#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "algebra/linalg/rayleigh_ritz.hpp"
#include "eigen/tracking/screen.hpp"
#include "eigen/tracking/track.hpp"

namespace squeal::tracking {

/// Two joined eigenvalues: their indices at both ends of the step, and |tr(Π Π')|.
struct Link {
  std::size_t here, there;
  double overlap;
};

/// The result of one step. It is discarded if the step is halved. Until all earlier steps are
/// finished, its branch numbers are indices of pairs at the lower end.
struct StepResult {
  std::vector<Link> links;
  std::vector<Event> events;
  std::vector<Gap> gaps;
  std::vector<ContinuedPair> singles;  ///< candidates for screen()
  bool sure = true;
};

/// A station with its problem.
struct SolvedStation {
  Station station;
  linalg::DenseProblem problem;
  linalg::Spectrum spectrum;
  std::optional<StepResult> step = {};  ///< from the preceding station
  bool whole = false;                   ///< the step from the preceding station must not be halved
  double smallest = 0;                  ///< smallest step here
  /// Index among the frictions of the path; for an inserted station, that of its lower neighbour.
  std::size_t place = 0;
};

/// Returns the event of an eigenvalue that changes its stability by itself, or of two equal
/// eigenvalues that change together. `event` has the pairs and frictions at both ends; `before` and
/// `after` are the signs of the growth rate there. Returns none if the stability does not change.
std::optional<Event> crossing(Event event, int before, int after);
/// Returns the event of one of several equal eigenvalues that split at the lower (atLow) or at the
/// upper end of a step. `event` has its branch, and the pairs and frictions at both ends. If `loss`
/// is true, the eigenvalue loses stability; otherwise it regains it.
Event splitting(Event event, bool loss, bool atLow);

/// Returns a step over which changes of stability of these eigenvalues may have been missed.
Gap notExamined(double low, double high, const std::vector<linalg::DensePair>& pairs);

}  // namespace squeal::tracking
