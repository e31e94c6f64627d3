// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The results of a sweep.
#include <algorithm>
#include <string>
#include <vector>

#include "base/petsc/owned.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/stability/followed.hpp"

namespace squeal::sweep_solver {

/// The results at consecutive steady points with the same active set, and the modes of that set.
struct ModalSegment {
  PetscInt openNodes = 0;  ///< contact nodes that are not active, over all ranks
  PetscInt unknowns = 0;   ///< n, number of unknowns
  /// Empty with the direct method; only the modes in the band if other active sets share the basis.
  /// A run with a mesh drops their vectors when it begins the next group of points.
  modes::Modes modes;
  /// The first Request::reportedModes modes in nodal displacements, N entries each, with a largest
  /// entry of magnitude 1.
  std::vector<OwnedVec> shapes;
  /// The shares of the components in the free modes of the band, [mode]; empty for matrices from
  /// files.
  std::vector<std::vector<pencil::Component>> components;
  std::vector<pencil::ComplexModes> points;  ///< for each damping factor, all steady points
  /// If eigenvalues are tracked, one entry for each combination of speed, pressure and damping
  /// whose first point is in `points` or, if that has no result, in an earlier segment. It may run
  /// on through the segments that follow.
  std::vector<stability::TrackedLine> trackedLines;
  long solves = 0;  ///< number of right-hand sides solved for the basis and for error estimates
};

/// Returns true if a point has been solved; the accuracy of other points is zero.
inline bool isSolved(const pencil::ComplexModes& point) { return point.accuracy > 0; }
/// Returns true if any point of the segment has been solved.
inline bool hasResults(const ModalSegment& segment) {
  return std::ranges::any_of(segment.points, isSolved);
}

/// The results of a problem.
struct SolvedSweep {
  std::vector<ModalSegment> segments;  ///< [range with at least one point]
  /// False if a stop has been requested: points and tracked eigenvalues may be missing.
  bool complete = true;
  /// The reason for each missing point or stage, one line per failure.
  std::vector<std::string> failures = {};
};

/// The part of a sweep that has been solved so far.
struct SweepState {
  std::vector<ModalSegment> segments;  ///< [range]
  std::vector<std::string> failures;   ///< of points and stages
  bool affine = true;                  ///< true if no point has terms of its own
  std::size_t solved = 0;              ///< number of points that have been solved and examined
  bool hasSetModes = false;            ///< the modes of the active sets are known
};

}  // namespace squeal::sweep_solver
