// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Results of the stages after the steady states, for a mesh and for matrices from files.
#include <mpi.h>

#include <string>
#include <vector>

#include "eigen/sweep_solver/results.hpp"
#include "regime/regime/regime.hpp"

namespace squeal::analysis {

/// Eigenvalues, and what follows from them.
struct Flutter {
  std::vector<sweep_solver::ModalSegment> segments = {};
  std::vector<regime::ModeOnset> onsets = {};  ///< of the unstable modes whose shapes are stored
  std::vector<regime::Study> regimes = {};     ///< motions after flutter
  /// Failures, each with its point and remedy, which leave all other results valid. They have been
  /// printed.
  std::vector<std::string> failures = {};
  bool complete = true;  ///< false if the run has been asked to stop

  /// Not collective. Adds the reason why a stage has no result, and prints it.
  void addFailure(MPI_Comm comm, const std::string& reason);
  /// Adds the results of further points. `complete` becomes that of `more`.
  void append(Flutter more);
};

}  // namespace squeal::analysis
