#pragma once
/// The algebraic part of the method, from K0, M0 and the terms of the pencil to the eigenvalues of a sweep: the same for a mesh and for
/// matrices from files.
#include <functional>
#include <vector>

#include "flutter/flutter.hpp"
#include "modes/modes.hpp"

namespace squeal {

/// Steady points of the sweep in a row with the same active set, and the modes of that set.
struct ModalSegment {
  PetscInt openNodes = 0;
  PetscInt unknowns = 0;
  modes::Modes modes;                          ///< empty with the direct method
  std::vector<OwnedVec> shapes;                ///< the first `-report_modes` modes in nodal displacements, largest entry 1
  std::vector<flutter::FrictionPoint> points;  ///< for each damping factor all steady points
  long solves = 0;                             ///< right-hand sides solved for to correct the basis and to estimate errors
};

/// What a segment is solved from; borrowed.
struct SegmentProblem {
  Mat k0 = nullptr, m0 = nullptr;
  std::function<KSP()> solver;  ///< of K0; asked for by the reduced method alone
  Mat trial = nullptr;          ///< from the unknowns to what is reported
  int modes = 0;                ///< their number
};

/// Collective. The modes, and flutter at all `steadyPoints` with all `dampings`; `termsAt(i)` makes the terms that belong to
/// steadyPoints[i] alone. `floor` is set by -modes_benchmark. Errors: of the stages modes and flutter.
ModalSegment solveSegment(const SegmentProblem& problem, flutter::Pencil pencil, const std::vector<Parameters>& steadyPoints,
                          const std::vector<double>& dampings,
                          const std::function<std::vector<flutter::Term>(std::size_t)>& termsAt, double& floor);

}  // namespace squeal
