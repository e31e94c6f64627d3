// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Steady sliding at all points of a sweep, and the changes of the contact between them.
#include <string>
#include <vector>

#include "base/checkpoint/checkpoint.hpp"
#include "eigen/sweep/sweep.hpp"
#include "run/analysis/current_system.hpp"
#include "run/analysis/settings.hpp"
#include "steady/condensed/contact_path.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::analysis {

/// The steady states of a sweep.
struct SteadyStates {
  /// [point of Sweep::steadyPoints()]; only those of the leading points if not `complete`.
  std::vector<steady::Solution> solutions;
  /// The changes of contact nodes of this rank between the points, in the order in which they
  /// occur.
  std::vector<condensed::ContactEvent> path;
  int events = 0;  ///< number of such changes on all ranks
  /// [point] if a line begins there (beginsLine()): why eigenvalues cannot be followed to it from
  /// friction 0 with its active set, empty if they can. No entries unless requested.
  std::vector<std::string> whyNotFromZero;
  bool complete = true;  ///< false if a request to stop ended the computation

  /// Returns the steady state at a point of the sweep, borrowed. Ignores the damping factor of the
  /// point.
  const steady::Solution& at(sweep::Parameters point) const;
};

/// The inputs of steadyStates(); borrowed.
struct SteadyInput {
  const Model& model;
  const sweep::Sweep& sweep;
  const SteadySettings& settings;
  bool fromZero = false;  ///< requests SteadyStates::whyNotFromZero
};

/// Returns true if a steady state was found at a point with friction, and none at any lower
/// friction of its line.
bool beginsLine(const std::vector<steady::Solution>& solutions, std::size_t point);

/// Returns why eigenvalues cannot be followed from friction 0 to a point if the contact changes
/// `changes` times on the way; empty if it does not change. `without` is the state without
/// friction, which may not have converged.
std::string whyNotFollowed(const steady::Solution& without, PetscInt changes);

/// Collective. Returns the steady states, and prints a line on each. The solution of a point starts
/// from the active set of a neighbour. For a point without a solution it prints a warning. Restores
/// and continues the log `steady` of the checkpoint. Throws Error as steady::Problem::solve() does,
/// and if a displacement is not finite.
SteadyStates steadyStates(const SteadyInput& input, checkpoint::Checkpoint& checkpoint,
                          CurrentSystem& system);

}  // namespace squeal::analysis
