// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The log of the steady states in the checkpoint.
#include "base/checkpoint/checkpoint.hpp"
#include "run/analysis/steady_sweep.hpp"

namespace squeal::analysis {

/// The log of the steady states. An entry contains the states that have been added since the last
/// entry.
class StateLog {
 public:
  /// Collective. Restores the states in the log to `states`. Borrows the arguments during the life
  /// of the object.
  StateLog(MPI_Comm comm, checkpoint::Checkpoint& checkpoint, SteadyStates& states);
  /// Collective. Writes an entry if one is due.
  void write();
  /// Collective. Writes the last entry if one is due, or if the computation of the states took
  /// long.
  void finish();

 private:
  void serialise(checkpoint::Archive& archive);
  void writeEntry();

  MPI_Comm comm_;
  checkpoint::Checkpoint& checkpoint_;
  SteadyStates& states_;
  std::size_t logged_ = 0;  // states in the log
  double begin_;            // s
};

}  // namespace squeal::analysis
