// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The checkpoint of a sweep.
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/checkpoint/checkpoint.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/reduction/reduced.hpp"
#include "eigen/sweep_solver/results.hpp"
#include "eigen/sweep_solver/sweep_plan.hpp"
#include "eigen/sweep_solver/sweep_problem.hpp"

namespace squeal::sweep_solver {

/// Records the state of a sweep in checkpoint logs whose names begin with `name`, and restores it.
class Journal {
 public:
  /// Borrows all arguments except the name during the lifetime of the object.
  Journal(checkpoint::Checkpoint& checkpoint, std::string name, const SweepProblem& problem,
          const SweepPlan& plan, SweepState& state)
      : checkpoint_(checkpoint),
        name_(std::move(name)),
        problem_(problem),
        plan_(plan),
        state_(state),
        begin_(MPI_Wtime()) {}

  /// Collective. Restores the segments of a finished sweep. Returns false if there are none.
  bool restoreFinished();
  /// Collective. Returns the recorded free modes of the interior unknowns; none if none are
  /// recorded.
  std::optional<modes::Modes> restoredModes();
  /// Collective. Restores the points and the basis; `basis` is null with the direct method.
  void restorePoints(reduction::ReducedProblem* basis);

  /// Collective. Records the results since the last entry, if an entry is due: first the free modes
  /// of the interior unknowns, then points and basis, then proofs of points recorded earlier.
  void record(modes::Modes& freeModes, reduction::ReducedProblem* basis);
  /// Not collective. Announces that these points of the plan have been solved once more: the proofs
  /// that follow are recorded together with the new results.
  void replace(const std::vector<std::size_t>& points);
  /// Collective. Saves the finished segments if their cost justifies an entry, so that an
  /// interrupted run need not repeat them.
  void recordFinished();

 private:
  void serialisePoints(checkpoint::Archive& archive, reduction::ReducedProblem* basis);
  void serialiseProofs(checkpoint::Archive& archive, std::vector<std::size_t> points);
  void serialiseFinished(checkpoint::Archive& archive);
  void recordProofs();
  pencil::ComplexModes& pointAt(std::size_t k);
  MPI_Comm comm() const { return problem_.pencil->comm(); }

  checkpoint::Checkpoint& checkpoint_;
  std::string name_;
  const SweepProblem& problem_;
  const SweepPlan& plan_;
  SweepState& state_;
  double begin_;  // s
  bool modesRecorded_ = false, setModesRecorded_ = false;
  std::size_t serialised_ = 0;  // number of solved points that the checkpoint contains
  // Points by their place in the order of the solution:
  std::set<std::size_t> proofs_;    // those whose proofs it contains
  std::set<std::size_t> replaced_;  // those that have been solved once more
};

}  // namespace squeal::sweep_solver
