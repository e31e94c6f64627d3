// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Checkpoints, from which a later run resumes an interrupted one.
#include <mpi.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "base/checkpoint/archive.hpp"
#include "base/checkpoint/identity.hpp"
#include "base/checkpoint/settings.hpp"

namespace squeal::checkpoint {

/// A folder with named logs. A log is a sequence of entries, each in a file of its own. An entry
/// contains the results since the previous entry; a run that resumes from the checkpoint reads the
/// entries in the same order. A file gets its name only when it is complete, so a run may be killed
/// at any moment; a single growing file would not survive that. Each rank writes its own part by
/// MPI, so only the same number of ranks can resume from a checkpoint.
///
/// If a run does not resume the checkpoint in the folder, that checkpoint stays there until the run
/// writes its own first entry or is complete. If an entry cannot be written, the run issues a
/// warning and continues without further checkpoints.
class Checkpoint {
 public:
  /// Makes a disabled checkpoint without entries.
  Checkpoint() = default;
  /// Collective. With `-resume`, next() reads the entries in the folder, and this constructor
  /// throws Error if they belong to another run. If there are none, it reports this, and the run
  /// starts from scratch. Without `-resume`, it warns if the folder contains entries. Also throws
  /// Error if a link, a device or the like is in the place of the folder or of a checkpoint file.
  Checkpoint(MPI_Comm comm, std::filesystem::path folder, Identity identity,
             const Settings& settings);

  /// Collective. Returns the next entry of a log; none after the last one. Throws Error if its file
  /// cannot be read or is damaged.
  std::optional<Archive> next(const std::string& log);
  /// Collective. Returns true if it is time for an entry. This is the case if enough time has
  /// passed since the last entry (`-checkpoint_interval`, or more if writing is slow), or if a stop
  /// of the run has been requested.
  bool due();
  /// Collective. Returns true if work that took so long is worth an entry of its own. Without it,
  /// the result could be lost until the next regular entry.
  bool isWorth(double seconds) const;
  /// Collective. Writes the next entry of a log.
  void write(const std::string& log, const Archive& archive);
  /// Returns true if the run resumes an earlier one.
  bool resumed() const { return resumed_; }
  /// Returns true if there is an entry on the disk from which a later run can resume.
  bool exists() const { return exists_; }
  /// Collective. Removes all entries. Call it when the run is complete.
  void remove();

 private:
  std::filesystem::path fileOf(const std::string& log, int number) const;
  void prepareFolder() const;
  void clear() const;

  MPI_Comm comm_ = MPI_COMM_NULL;
  std::filesystem::path folder_;
  Identity identity_;
  Settings settings_{.enabled = false};
  bool resumed_ = false, begun_ = false, exists_ = false;
  double last_ = 0;                   // time of the last entry, s
  double cost_ = 0;                   // time to write the last entry, s
  std::map<std::string, int> read_;   // [log] entries read
  std::map<std::string, int> count_;  // [log] entries in the folder
};

}  // namespace squeal::checkpoint
