#pragma once
/// Where a run is: one line per stage with its wall time, progress within long stages, and the
/// record for the summary.
#include <mpi.h>

#include <string>
#include <vector>

namespace squeal {

struct StageRecord {
  std::string name;
  double seconds = 0;  ///< wall time, maximum over the ranks
  /// High-water mark of resident memory at the end of the stage, summed over the ranks
  double peakMemoryBytes = 0;
};

/// A stage of the method, from construction to finish(). Collective.
class Stage {
 public:
  Stage(MPI_Comm comm, std::string name);
  /// Says on the terminal (rank 0, unless -quiet) what was found, with the time; keeps the record.
  void finish(const std::string& result);
  /// Progress of long work, a line every two seconds at most: plain lines, since output of parallel
  /// jobs goes through pipes and files.
  void progress(const std::string& text);
  /// Says at once what one of several tasks of the stage found.
  void say(const std::string& text);

 private:
  MPI_Comm comm_;
  std::string name_;
  double begin_, lastProgress_;
};

/// Text for the user on rank 0, silent with -quiet.
void say(MPI_Comm comm, const std::string& text);
/// Not collective. On the standard output at once, whether or not it can be written: no run is lost
/// for its terminal.
void print(const std::string& text);
/// errno of the first output that could not be written; 0 where all could, or where its reader has
/// gone, as `head` does.
int outputError();
/// A warning on the standard error output of rank 0, also with -quiet.
void complain(MPI_Comm comm, const std::string& text);
/// All finished stages in order; stages finished several times (one per friction) are summed.
const std::vector<StageRecord>& stageRecords();

}  // namespace squeal
