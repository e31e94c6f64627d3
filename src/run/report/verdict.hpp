// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The verdict of a whole run: one sentence, and its figures.
#include <optional>
#include <string>

#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// The verdict on the stability of a sweep.
struct RunVerdict {
  std::string sentence;    ///< with a capital letter and a full stop
  int points = 0;          ///< of the sweep
  int pointsSolved = 0;    ///< with eigenvalues, or with a list that is empty
  int pointsUnstable = 0;  ///< with an unstable mode
  int mostUnstable = 0;    ///< largest number of unstable modes at one point
  int undecided = 0;       ///< eigenvalues of all points whose sign of growth is within the error
  int uncertified = 0;     ///< eigenvalues of all points without a certificate
  /// The lowest critical friction at which stability is lost; none if it was not computed, if more
  /// than one parameter is swept, or if a point at lower friction is unstable.
  std::optional<double> criticalFriction;
};

/// Returns the verdict of a run, complete or interrupted.
RunVerdict runVerdict(const analysis::Analysis& analysis);

}  // namespace squeal::report
