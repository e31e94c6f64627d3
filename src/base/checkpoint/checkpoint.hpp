#pragma once
/// A checkpoint lets a run that has been ended before its time be continued.
#include <mpi.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "base/checkpoint/archive.hpp"
#include "base/checkpoint/identity.hpp"

namespace squeal::checkpoint {

/// A Checkpoint is a folder with a file for each entry of some logs, which are told apart by names.
/// A run writes what it has found since the last entry, and reads the entries in the same order
/// when it is continued. A file appears whole, by renaming, so that a run may be killed at any
/// moment; a single file that grows would not outlive that. Each rank writes its own part of it, by
/// MPI, so that a checkpoint is of as many ranks as it was made by.
///
/// A checkpoint of an earlier run in the folder stays until the first entry of this one, unless
/// this one continues it. Where nothing can be written, a warning says so and the run goes on.
class Checkpoint {
 public:
  /// Makes a checkpoint that has no entries and takes none.
  Checkpoint() = default;
  /// Collective. With `resumes`, the entries in the folder are those to be read. Throws Error if
  /// these are of another identity or damaged. Where there are none, the log says so, and the run
  /// begins anew.
  Checkpoint(MPI_Comm comm, std::filesystem::path folder, Identity identity, bool resumes);

  /// Collective. Returns the next entry of a log; none behind the last one. Throws Error if its
  /// file cannot be read or is damaged.
  std::optional<Archive> next(const std::string& log);
  /// Collective. Returns true if it is time for an entry: `-checkpoint_interval` has passed since
  /// the last one, longer where writing takes long, or the run has been asked to stop.
  bool due();
  /// Collective. Returns true if work of so many seconds is worth an entry at its end, since there
  /// may be none for a while.
  bool isWorth(double seconds) const;
  /// Collective. Writes the next entry of a log.
  void write(const std::string& log, const Archive& archive);
  /// Returns true if the run continues an earlier one.
  bool resumed() const { return resumed_; }
  /// Returns true if there is an entry on the disc that a later run can continue from.
  bool exists() const { return exists_; }
  /// Collective. Removes all entries, once the run is complete.
  void remove();

 private:
  std::filesystem::path fileOf(const std::string& log, int number) const;
  void beginAnew();
  void clear() const;
  bool read(const std::filesystem::path& path, std::vector<char>& common, std::vector<char>& own);

  MPI_Comm comm_ = MPI_COMM_NULL;
  std::filesystem::path folder_;
  Identity identity_;
  bool enabled_ = false, resumed_ = false, begun_ = false, exists_ = false;
  double last_ = 0;                   // time of the last entry, s
  double cost_ = 0;                   // that it took, s
  std::map<std::string, int> read_;   // [log] entries read
  std::map<std::string, int> count_;  // [log] entries in the folder
};

/// Returns the option `-resume`.
bool resumeWanted();

}  // namespace squeal::checkpoint
