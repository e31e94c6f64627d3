// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// These functions write the output of a run: tables, fields, the summary and the stability table
/// on the terminal.
#include <filesystem>
#include <string>
#include <vector>

#include "base/output/folder.hpp"
#include "run/analysis/analysis.hpp"
#include "run/report/settings.hpp"

namespace squeal::report {

/// The folder of a run (`-report_dir`), where new results replace those of an earlier run when all
/// are complete.
class Directory : public output::Folder {
 public:
  /// Collective. `points` are those of the sweep. Call it when all settings have been read: it
  /// writes them to options.txt in staging(), so that a run that is killed leaves them. Throws
  /// Error as output::Folder does.
  Directory(MPI_Comm comm, const Settings& settings, std::vector<sweep::Parameters> points);
  /// Returns the points of the sweep, borrowed.
  const std::vector<sweep::Parameters>& points() const { return points_; }
  /// Returns the folder inside it for what a run leaves that has been asked to stop.
  std::filesystem::path interrupted() const { return path() / "interrupted"; }

 private:
  std::vector<sweep::Parameters> points_;
};

/// Collective. Writes all reports, which then replace those of an earlier run, and prints the
/// stability table. Those of a run that has been asked to stop go to interrupted() instead, and the
/// results of an earlier run stay; there are none if no eigenvalue has been found. Throws Error,
/// naming -report_dir, if a file cannot be written; the earlier results then stay.
void write(const analysis::Analysis& analysis, const Settings& settings, Directory& directory);

/// Collective. Removes the results of an interrupted run in interrupted(), except its checkpoint. A
/// failure is a warning.
void removeInterrupted(MPI_Comm comm, const Directory& directory);

/// Collective. Writes the file on rank 0. Throws Error on all ranks, naming -report_dir, if that
/// fails.
void writeText(MPI_Comm comm, const std::filesystem::path& path, const std::string& text);

}  // namespace squeal::report
