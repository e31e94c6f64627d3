// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The results of a sweep.
#include <string>
#include <vector>

#include "base/petsc/owned.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/stability/followed.hpp"

namespace squeal::sweep_solver {

/// The results at steady points in a row that share one active set, and the modes of that set.
struct ModalSegment {
  PetscInt openNodes = 0;  ///< contact nodes that are not active, over all ranks
  PetscInt unknowns = 0;   ///< n
  modes::Modes modes;      ///< empty with the direct method; those of the band if the basis is
                           ///< shared with other active sets
  /// The first modes, Request::reportedModes of them, in nodal displacements, N entries each, with
  /// a largest entry of magnitude 1.
  std::vector<OwnedVec> shapes;
  std::vector<pencil::ComplexModes> points;  ///< for each damping factor all steady points
  /// For each speed, pressure and damping whose first point is one of these, if eigenvalues are
  /// followed.
  std::vector<stability::Followed> followed;
  long solves = 0;  ///< right-hand sides solved for to correct the basis and to estimate errors
};

/// The results of a problem.
struct SolvedSweep {
  std::vector<ModalSegment> segments;  ///< [range of points that has any]
  /// False if the run has been asked to stop: points and followed eigenvalues may be missing.
  bool complete = true;
  /// The reason for each missing point or stage: a line for each that failed.
  std::vector<std::string> failures = {};
};

/// The part of a sweep that has been solved so far.
struct SweepState {
  std::vector<ModalSegment> segments;  ///< [range]
  std::vector<std::string> failures;   ///< of points and stages
  bool affine = true;                  ///< no point has terms of its own
  std::size_t solved = 0;              ///< points that have been solved and examined
  bool hasSetModes = false;            ///< the modes of the active sets are known
};

}  // namespace squeal::sweep_solver
