#pragma once
/// These functions write the log of a run: one line per stage with its wall time, and progress
/// within long stages. They keep the record for the summary.
#include <mpi.h>

#include <optional>
#include <string>
#include <vector>

#include "base/petsc/log_events.hpp"

namespace squeal {

/// The record of a stage for the summary.
struct StageRecord {
  std::string name;
  double seconds = 0;  ///< wall time, s, the largest of all ranks
  /// Peak of the resident memory at the end of the stage, bytes, summed over the ranks.
  double peakMemoryBytes = 0;
  /// Messages sent by PETSc and this program, and their bytes, summed over the ranks; most
  /// reductions and broadcasts of a rank. MUMPS counts none of its own.
  Traffic traffic;
};

/// A Stage is a stage of the method, from construction to finish(), and a stage of PETSc's log.
/// Only finish() is collective.
class Stage {
 public:
  Stage(MPI_Comm comm, std::string name);
  ~Stage();
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;
  /// Collective. Prints the result with the time (on rank 0, unless -quiet) and keeps the record.
  void finish(const std::string& result);
  /// Prints the progress of long work (on rank 0, unless -quiet), at most a line every two seconds.
  void progress(const std::string& text);
  /// Prints the result of one of several tasks of the stage at once (on rank 0, unless -quiet).
  void say(const std::string& text);

 private:
  MPI_Comm comm_;
  std::string name_;
  double begin_, lastProgress_;
  Traffic before_;
  std::optional<LoggedStage> logged_;
};

/// Returns the option `-quiet`.
bool isQuiet();
/// Not collective. Prints text on rank 0, unless -quiet is given.
void say(MPI_Comm comm, const std::string& text);
/// Not collective. Prints text on the standard output at once. A failure to write does not end the
/// run; outputError() keeps it.
void print(const std::string& text);
/// Returns errno of the first output that could not be written; 0 if all could be written, or if
/// the reader has gone, as `head` goes.
int outputError();
/// Not collective. Prints a warning on the standard error output of rank 0, also with -quiet.
void complain(MPI_Comm comm, const std::string& text);
/// Not collective. Returns all finished stages in order; borrowed. The times of a stage that was
/// finished several times, such as once per friction, are summed; its memory is that at the last
/// end.
const std::vector<StageRecord>& stageRecords();

}  // namespace squeal
