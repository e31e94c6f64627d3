// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Results of all stages after steady sliding, for a mesh and for matrices from files.
#include <mpi.h>

#include <string>
#include <vector>

#include "eigen/sweep_solver/results.hpp"
#include "problem/energies/body_motions.hpp"
#include "regime/regime/regime.hpp"

namespace squeal::analysis {

/// The eigenvalues of a sweep, the onset of nonlinearity of its modes, and the motions after
/// flutter.
struct Flutter {
  std::vector<sweep_solver::ModalSegment> segments = {};
  std::vector<regime::ModeOnset> onsets = {};  ///< first separation, stick or slip of the stored
                                               ///< unstable modes as they grow
  std::vector<regime::Study> regimes = {};     ///< motions after flutter
  std::vector<std::vector<energies::NamedMode>> ownModes = {};  ///< [body] elastic modes of each
                                                                ///< body by itself, if wanted
  /// Messages of failures, each with the point of the sweep and the remedy. All other results are
  /// valid. The program has already printed the messages.
  std::vector<std::string> failures = {};
  bool complete = true;  ///< false if a signal has stopped the run

  /// Not collective. Adds and prints the reason why a stage has no result.
  void addFailure(MPI_Comm comm, const std::string& reason);
  /// Adds the results of further points. `complete` becomes that of `more`.
  void append(Flutter more);
};

}  // namespace squeal::analysis
