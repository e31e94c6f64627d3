#pragma once
/// The algebraic part of the method, from K0, M0 and the terms of the pencil to the eigenvalues of
/// a sweep: the same for a mesh and for matrices from files.
#include <functional>
#include <optional>
#include <vector>

#include "modes/modes.hpp"
#include "pencil/complex_modes.hpp"
#include "pencil/pencil.hpp"
#include "sensitivity/left.hpp"
#include "sweep/parameters.hpp"
#include "tracking/followed.hpp"

namespace squeal::analysis {

/// Steady points of the sweep in a row with the same active set, and the modes of that set.
struct ModalSegment {
  PetscInt openNodes = 0;
  PetscInt unknowns = 0;
  modes::Modes modes;  ///< empty with the direct method
  /// The first `-report_modes` modes in nodal displacements, largest entry 1
  std::vector<OwnedVec> shapes;
  std::vector<pencil::FrictionPoint> points;  ///< for each damping factor all steady points
  std::vector<tracking::Followed> followed;   ///< for each speed, pressure and damping
  long solves = 0;  ///< right-hand sides solved for to correct the basis and to estimate errors
};

/// What a segment is solved from; matrices are borrowed.
struct SegmentProblem {
  Mat k0 = nullptr, m0 = nullptr;
  std::function<KSP()> solver;                  ///< of K0
  Mat trial = nullptr;                          ///< from the unknowns to what is reported
  int modes = 0;                                ///< their number
  std::vector<sweep::Parameters> steadyPoints;  ///< for all damping factors
  /// The terms that belong to steadyPoints[i] alone; none: there are none.
  std::function<std::vector<pencil::Term>(std::size_t)> termsAt;
  /// The terms that belong to any point alone, between those of the sweep, where termsAt gives any;
  /// none: it cannot be had.
  std::function<std::optional<std::vector<pencil::Term>>(const sweep::Parameters&)> termsOf;
  /// What else is to be found of steadyPoints[i], given its pencil and a space for left vectors to
  /// start from; none: nothing.
  std::function<void(std::size_t, const pencil::Pencil&, const sensitivity::StartSpace&,
                     pencil::FrictionPoint&)>
      examine;
};

/// Collective. The modes, and flutter at all steady points with all `dampings`. `floor` is set by
/// -modes_benchmark. Errors: of the stages modes and flutter.
ModalSegment solveSegment(const SegmentProblem& problem, pencil::Pencil pencil,
                          const std::vector<double>& dampings, double& floor);

}  // namespace squeal::analysis
