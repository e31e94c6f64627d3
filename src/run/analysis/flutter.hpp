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

/// The eigenvalues of a sweep, the first contact events as its modes grow, and the motions after
/// the onset of flutter.
struct Flutter {
  std::vector<sweep_solver::ModalSegment> segments = {};
  /// First separation, stick or slip of each stored unstable mode as it grows.
  std::vector<regime::ModeOnset> onsets = {};
  std::vector<regime::Study> regimes = {};  ///< motions after the onset of flutter
  /// [body] The elastic modes of each body by itself, if requested.
  std::vector<std::vector<energies::NamedMode>> ownModes = {};
  /// The messages of failures, which have already been printed. Each names the point of the sweep
  /// and the remedy. All other results are valid.
  std::vector<std::string> failures = {};
  bool complete = true;  ///< false if a request to stop ended the computation

  /// Returns the highest of the points' upper band limits, rad/s; infinity if there is none.
  double bandTop() const;
  /// Not collective. Prints the reason why a stage has no result, and adds it to `failures`.
  void addFailure(MPI_Comm comm, const std::string& reason);
  /// Adds the results `more` of further points. Tracked lines with the same speed, pressure and
  /// damping become one. `complete` takes its value from `more`.
  void append(Flutter more);
};

}  // namespace squeal::analysis
