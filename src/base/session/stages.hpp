// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Writes the log of a run: one line per stage with its wall time, and progress within long stages.
/// Also records the stages for the summary.
#include <mpi.h>

#include <optional>
#include <string>
#include <vector>

#include "base/petsc/log_events.hpp"

namespace squeal {

/// The record of a stage for the summary.
struct StageRecord {
  std::string name;
  double seconds = 0;  ///< wall time, s, maximum over the ranks
  /// Peak resident memory at the end of the stage, bytes, summed over the ranks.
  double peakMemoryBytes = 0;
  /// Messages sent by PETSc and this program, and their bytes, summed over the ranks; reductions
  /// and broadcasts, maximum over the ranks. Messages of MUMPS are not included.
  Traffic traffic;
  SparseWork work;
};

/// A stage of the method, from construction to finish(). It is also a stage in PETSc's log. Only
/// finish() is collective.
class Stage {
 public:
  Stage(MPI_Comm comm, std::string name);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;
  /// Collective. Prints the result with the time (on rank 0, unless -quiet) and records the stage.
  void finish(const std::string& result);
  /// Prints progress of long work (on rank 0, unless -quiet), at most one line every two seconds.
  void progress(const std::string& text);
  /// Immediately prints the result of one of several tasks of the stage (on rank 0, unless -quiet).
  void printLine(const std::string& text);

 private:
  MPI_Comm comm_;
  std::string name_;
  double begin_, lastProgress_;
  Traffic before_;
  SparseWork workBefore_;
  std::optional<LoggedStage> logged_;
};

/// Not collective. If `quiet`, prints only warnings and errors from here on; otherwise prints
/// everything again.
void setQuiet(bool quiet);
/// Returns true if only warnings and errors are printed.
bool isQuiet();
/// Not collective. Prints text on rank 0, unless -quiet is given.
void printLine(MPI_Comm comm, const std::string& text);
/// Not collective. Immediately prints text on the standard output. A failure to write does not end
/// the run; outputError() returns the reason.
void print(const std::string& text);
/// Returns errno of the first output that could not be written; 0 if there is none, or if the
/// reader has closed the pipe, as `head` does.
int outputError();
/// Not collective. Prints a warning on the standard error output of rank 0, also with -quiet.
void printWarning(MPI_Comm comm, const std::string& text);
/// Not collective. Returns all finished stages in order; borrowed. If a stage finishes several
/// times, for example once per friction, its record contains the last memory value and the sums of
/// all other values.
const std::vector<StageRecord>& stageRecords();

}  // namespace squeal
