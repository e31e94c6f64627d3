// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The stages of the method are called here in their order, from the input to flutter. Reporting
/// takes the results from here.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/checkpoint/checkpoint.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/sweep/parameters.hpp"
#include "eigen/sweep/sweep.hpp"
#include "eigen/sweep_solver/sweep_solver.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/mesh/mesh.hpp"
#include "regime/regime/regime.hpp"
#include "run/analysis/settings.hpp"
#include "steady/condensed/contact_path.hpp"
#include "steady/steady/steady.hpp"
#include "steady/uniqueness/uniqueness.hpp"

namespace squeal::analysis {

/// The number of steady states at one speed, for all frictions, as far as it is known.
struct SpeedUniqueness {
  double speed = 1;  ///< v
  uniqueness::Uniqueness found;
};

/// All results of a run, and the problem that they belong to.
struct Analysis {
  MPI_Comm comm = MPI_COMM_NULL;
  Settings settings;
  sweep::Sweep sweep;
  /// The mesh, at a fixed address, since contact and steady sliding borrow it; null for matrices
  /// from files, where bodies, contact and steady states are empty.
  std::unique_ptr<mesh::Mesh> mesh;
  elasticity::Bodies bodies;
  contact::Contact contact;
  std::vector<steady::Solution> steady;  ///< [steady point of the sweep]
  /// Where on the way between them contact nodes of this rank open and close, in order; and the
  /// number of such events on all ranks.
  std::vector<condensed::ContactEvent> contactPath;
  int contactEvents = 0;
  std::vector<SpeedUniqueness> uniqueness;  ///< one entry for all speeds where they share it; empty
                                            ///< unless -steady_uniqueness
  std::vector<sweep_solver::ModalSegment> segments;
  std::vector<regime::ModeOnset> onsets;  ///< of the unstable modes whose shapes are kept
  std::vector<regime::Study> regimes;     ///< after flutter, at the points of `-regime_friction`
  /// Failures of late stages, by point and remedy: they leave all other results as they are. They
  /// have been printed.
  std::vector<std::string> failures;
  int reportedModes = 0;  ///< number of free modes whose shapes are reported
  checkpoint::Checkpoint checkpoint;
  /// True if the run has been asked to stop before all was found.
  bool interrupted = false;

  /// Returns true if every steady point has a solution, as for matrices from files, and no late
  /// stage has failed.
  bool converged() const;
  /// Returns the complex modes at a point of the sweep, borrowed; null where there is no steady
  /// solution.
  const pencil::ComplexModes* pointAt(const sweep::Parameters& at) const;
};

/// Returns what is asked of the sweep over the eigenvalues.
sweep_solver::Request requestOf(const Analysis& analysis);

/// Collective. Adds the reason why a stage has no result, and prints it.
void addFailure(Analysis& analysis, const std::string& reason);

/// Collective. Returns all that comes before the first solution: the sweep and, for a mesh, the
/// mesh, the matrices of the bodies and contact. Matrices from files are read later.
/// Throws Error as the stages document it.
Analysis prepare(MPI_Comm comm, const Settings& settings);

/// Collective. Runs all stages that the options, which have been checked, ask for, and returns the
/// results; those that there are where the run has been asked to stop. The folder is for the
/// checkpoint; an empty path: there is none. `reportedModes` is the number of free modes whose
/// shapes are reported. Throws Error as the stages and the checkpoint document it.
Analysis analyse(MPI_Comm comm, const Settings& settings,
                 const std::filesystem::path& checkpointFolder = {}, int reportedModes = 10);

}  // namespace squeal::analysis
