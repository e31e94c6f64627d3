#pragma once
/// The method from mesh to flutter, one call per section of the paper. Reporting takes it from
/// here.
#include <memory>
#include <vector>

#include "analysis/segment.hpp"
#include "elasticity/elasticity.hpp"
#include "mesh/mesh.hpp"
#include "pencil/complex_modes.hpp"
#include "steady/steady.hpp"
#include "steady/uniqueness.hpp"
#include "sweep/parameters.hpp"
#include "sweep/sweep.hpp"

namespace squeal::analysis {

/// The number of steady states at one speed, for all frictions, as far as it is known.
struct SpeedUniqueness {
  double speed = 1;
  steady::Uniqueness found;
};

struct Analysis {
  MPI_Comm comm = MPI_COMM_NULL;
  sweep::Sweep sweep;
  /// At a fixed address: contact and steady borrow it; null: matrices from files
  std::unique_ptr<mesh::Mesh> mesh;
  elasticity::Bodies bodies;
  contact::Contact contact;
  std::vector<steady::Solution> steady;     ///< [steady point of the sweep]
  std::vector<SpeedUniqueness> uniqueness;  ///< one entry for all speeds where they share it; empty
                                            ///< unless -steady_uniqueness
  std::vector<ModalSegment> segments;
  /// One factorisation and 400 blocked solves, if `-modes_benchmark`
  double modesFloorSeconds = 0;

  /// Every point has a steady solution.
  bool converged() const;
  /// Returns the complex modes at a point of the sweep; null where there is no steady solution.
  const pencil::ComplexModes* pointAt(const sweep::Parameters& at) const;
};

/// Collective. Error for options that are unknown, out of range or idle: all that can be told
/// before a file is read or written.
void checkOptions();

/// Collective. All that comes before the first solution: sweep, and mesh, matrices of the bodies
/// and contact; options have been checked. Errors as the stages document them.
Analysis prepare(MPI_Comm comm);

/// Collective. Runs all stages that the options, which have been checked, ask for. Errors as the
/// stages document them.
Analysis analyse(MPI_Comm comm);

}  // namespace squeal::analysis
