#pragma once
/// The method from mesh to flutter, one call per section of the paper. Reporting takes it from here.
#include <memory>
#include <vector>

#include "flutter/flutter.hpp"
#include "flutter/followed.hpp"
#include "modes/modes.hpp"
#include "steady/steady.hpp"
#include "steady/uniqueness.hpp"

namespace squeal {

/// What is known of the number of steady states at one speed, for all frictions.
struct SpeedUniqueness {
  double speed = 1;
  steady::Uniqueness found;
};

/// Steady points of the sweep in a row with the same active set, and the modes of that set.
struct ModalSegment {
  PetscInt openNodes = 0;
  PetscInt unknowns = 0;
  modes::Modes modes;                          ///< empty with the direct method
  std::vector<OwnedVec> shapes;                ///< the first `-report_modes` modes in nodal displacements, largest entry 1
  std::vector<flutter::FrictionPoint> points;  ///< for each damping factor all steady points
  std::vector<flutter::Followed> followed;     ///< for each speed, pressure and damping
  long solves = 0;                             ///< right-hand sides solved for to correct the basis and to estimate errors
};

struct Analysis {
  flutter::Sweep sweep;
  std::unique_ptr<mesh::Mesh> mesh;  ///< at a fixed address: contact and steady borrow it
  elasticity::Bodies bodies;
  contact::Contact contact;
  std::vector<steady::Solution> steady;     ///< [steady point of the sweep]
  std::vector<SpeedUniqueness> uniqueness;  ///< one entry for all speeds where they share it; empty unless -steady_uniqueness
  std::vector<ModalSegment> segments;
  double modesFloorSeconds = 0;  ///< one factorisation and 400 blocked solves, if `-modes_benchmark`

  /// Every point has a steady solution.
  bool converged() const;
  /// What was found at a point of the sweep; null where there is no steady solution.
  const flutter::FrictionPoint* pointAt(const Parameters& at) const;
};

/// What the options of all stages ask of the mesh.
mesh::Request meshRequest();

/// Collective. Runs all stages that the options ask for. Errors as the stages document them.
Analysis analyse(MPI_Comm comm);

}  // namespace squeal
