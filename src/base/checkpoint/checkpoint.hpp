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

/// A folder with a file for each entry of some named logs. A run writes its results since the last
/// entry; a run that resumes it reads the entries in the same order. Renaming makes each file
/// appear complete, so a run may be killed at any moment; a single growing file would not survive
/// that. Each rank writes its own part, by MPI, so only the same number of ranks can resume from a
/// checkpoint.
///
/// Unless this run resumes it, a checkpoint of an earlier run stays in the folder until the first
/// entry of this one. If an entry cannot be written, the run issues a warning and continues.
class Checkpoint {
 public:
  /// Makes a disabled checkpoint without entries.
  Checkpoint() = default;
  /// Collective. With `-resume`, next() reads the entries in the folder, and Error is thrown if
  /// they belong to another run or are damaged. If there are none, the log reports this, and the
  /// run starts from scratch.
  Checkpoint(MPI_Comm comm, std::filesystem::path folder, Identity identity,
             const Settings& settings);

  /// Collective. Returns the next entry of a log; none after the last one. Throws Error if its file
  /// cannot be read or is damaged.
  std::optional<Archive> next(const std::string& log);
  /// Collective. Returns true if it is time for an entry: `-checkpoint_interval`, or longer if
  /// writing is slow, has passed since the last one, or a stop of the run has been requested.
  bool due();
  /// Collective. Returns true if work of this duration justifies an entry at its end. The next
  /// regular entry may come much later.
  bool isWorth(double seconds) const;
  /// Collective. Writes the next entry of a log.
  void write(const std::string& log, const Archive& archive);
  /// Returns true if the run resumes an earlier one.
  bool resumed() const { return resumed_; }
  /// Returns true if there is an entry on the disk from which a later run can resume.
  bool exists() const { return exists_; }
  /// Collective. Removes all entries, once the run is complete.
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
  double cost_ = 0;                   // time that it took, s
  std::map<std::string, int> read_;   // [log] entries read
  std::map<std::string, int> count_;  // [log] entries in the folder
};

}  // namespace squeal::checkpoint
