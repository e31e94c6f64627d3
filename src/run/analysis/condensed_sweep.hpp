// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Solves for the steady states of a sweep in the unknowns of the contact.
#include <optional>
#include <vector>

#include "run/analysis/current_system.hpp"
#include "run/analysis/state_log.hpp"
#include "run/analysis/steady_sweep.hpp"
#include "steady/condensed/condensed_problem.hpp"

namespace squeal::analysis {

/// Solves for the steady states in batches with the factorisation of the closed contact, and
/// follows the changes of contact between neighbouring points. All public members are collective.
class CondensedSweep {
 public:
  /// Borrows all arguments during the lifetime of the object. During this time, do not call
  /// current.of(). `states` contains the states of the leading points that are already known.
  CondensedSweep(const SteadyInput& input, CurrentSystem& current, SteadyStates& states);
  /// Adds the missing states and, without convective terms, the path between them. Writes both to
  /// the log.
  void solve(StateLog& log);

 private:
  /// A pair of neighbouring points, as indices into SteadyStates::solutions. The path leads from
  /// the first to the second.
  struct Step {
    std::size_t from, to;
  };
  void solveBatch(const std::vector<sweep::Parameters>& points);
  void continueFromLast();
  void solveAgain(std::size_t point);
  void continueTo(const steady::Solution& from, steady::Solution& solution);
  void continueFromNeighbour(std::size_t point);
  void solveFromNearest(std::size_t point);
  void solveWithPivots(std::size_t point);
  void solveInAllUnknowns(std::size_t point);
  std::string stepText(const Step& step) const;
  std::vector<Step> stepsToFollow(std::size_t begin) const;
  void followPath(const Step& step);
  void addEvents(std::vector<condensed::ContactEvent> events, int count, const Step& step);
  void examineBelow();
  std::string whyNotFromZero(const steady::Solution& first);
  void takeSolutionOfPath(condensed::ContactPath& path, const Step& step);

  const SteadyInput input_;
  const MPI_Comm comm_;
  const steady::Problem problem_;
  const contact::CoupledSystem& closed_;  // system with all contact nodes closed
  const bool isExact_;                    // solutions between points are exact without corrections
  std::optional<condensed::CondensedProblem> condensed_;
  SteadyStates& states_;
};

}  // namespace squeal::analysis
