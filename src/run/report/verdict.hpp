// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The verdict of a whole run: a sentence, and figures.
#include <optional>
#include <string>

#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// The verdict on the stability of a sweep.
struct RunVerdict {
  std::string sentence;    ///< begins with a capital letter, ends with a full stop
  int points = 0;          ///< points of the sweep
  int pointsSolved = 0;    ///< points with a list of eigenvalues, which may be empty
  int pointsUnstable = 0;  ///< points with an unstable mode
  int mostUnstable = 0;    ///< largest number of unstable modes at one point
  int pointsUnknown = 0;   ///< points with an empty list that is not proved to be complete
  int undecided = 0;       ///< eigenvalues of all points with the verdict `undecided`
  int uncertified = 0;     ///< eigenvalues of all points with the verdict `uncertified`
  /// The lowest critical friction at which an eigenvalue in the band loses stability. None if it
  /// was not computed, if more than one parameter is swept, or if a point of the sweep at a lower
  /// friction is unstable.
  std::optional<double> criticalFriction;
};

/// Returns the verdict of a run, complete or interrupted.
RunVerdict runVerdict(const analysis::Analysis& analysis);

}  // namespace squeal::report
