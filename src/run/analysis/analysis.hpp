// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The whole analysis, from the input to the motion after the onset of flutter. The reports are
/// made from its results.
#include <filesystem>
#include <optional>
#include <string>

#include "base/checkpoint/checkpoint.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/sweep/sweep.hpp"
#include "run/analysis/flutter.hpp"
#include "run/analysis/matrix_referee.hpp"
#include "run/analysis/model.hpp"
#include "run/analysis/settings.hpp"
#include "run/analysis/speed_uniqueness.hpp"
#include "run/analysis/steady_sweep.hpp"

namespace squeal::analysis {

/// The problem and the results of a run. The input is a mesh or a set of matrices from files; with
/// matrices, the run has no model and no steady states.
struct Analysis {
  MPI_Comm comm = MPI_COMM_NULL;
  Settings settings;
  sweep::Sweep sweep;
  Model model;                        ///< empty for matrices from files
  std::optional<audit::Audit> audit;  ///< of the model; none if it is not wanted
  SteadyStates steady;                ///< empty for matrices from files
  UniquenessStudy uniqueness;         ///< of the steady states
  Flutter flutter;
  /// The eigenvalues listed in the file `-referee_list`, each with its judgement; none without it.
  std::optional<JudgedList> judged;
  checkpoint::Checkpoint checkpoint;

  /// Returns true if a stop was requested before the run had all results.
  bool interrupted() const { return !(steady.complete && uniqueness.complete && flutter.complete); }
  /// Returns true if every steady state that the run looked for was found, and no later stage has
  /// failed. For matrices from files, only the second condition applies.
  bool converged() const;
  /// Returns the complex modes at a point of the sweep, borrowed; null if the point has none.
  const pencil::ComplexModes* pointAt(const sweep::Parameters& at) const;
};

/// Collective. Runs all stages that the settings request, and returns their results. If a stop is
/// requested, returns the results obtained so far. Checkpoints are written to `checkpointFolder`;
/// if this is empty, none is written. `reportedModes` is the number of free modes whose shapes are
/// reported. Throws Error under the conditions documented for the stages and for the checkpoint.
Analysis analyse(MPI_Comm comm, const Settings& settings,
                 const std::filesystem::path& checkpointFolder = {}, int reportedModes = 10);

}  // namespace squeal::analysis
