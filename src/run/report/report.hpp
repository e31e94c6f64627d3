// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The output of a run: tables, fields and the summary in files, the stability table on the
/// terminal.
#include <filesystem>
#include <string>
#include <vector>

#include "base/output/folder.hpp"
#include "run/analysis/analysis.hpp"
#include "run/report/settings.hpp"

namespace squeal::report {

/// The results folder of a run (`-report_dir`). The new results replace those of an earlier run as
/// soon as they are complete.
class Directory : public output::Folder {
 public:
  /// Collective. `points` are the points of the sweep. Call it after all settings have been read.
  /// It writes options.txt to the folder staging(), where the file remains even if the run is
  /// killed. Throws Error as output::Folder does.
  Directory(MPI_Comm comm, const Settings& settings, std::vector<sweep::Parameters> points);
  /// Returns the points of the sweep, borrowed.
  const std::vector<sweep::Parameters>& points() const { return points_; }
  /// Returns the subfolder for the results of an interrupted run.
  std::filesystem::path interrupted() const { return path() / "interrupted"; }

 private:
  std::vector<sweep::Parameters> points_;
};

/// Collective. Writes all reports and prints the stability table. Once complete, the reports
/// replace those of an earlier run. If the run was interrupted and has eigenvalues, its reports are
/// written to interrupted() instead, and the results of an earlier run remain. If it has none, they
/// remain too, except those in interrupted(), and a warning is printed. Throws Error, naming
/// -report_dir, if a file of a complete run cannot be written; the earlier results then remain. For
/// an interrupted run, this is only a warning.
void write(const analysis::Analysis& analysis, const Settings& settings, Directory& directory);

/// Collective. Removes the results of an interrupted run from interrupted(), except its checkpoint.
/// Prints a warning if this fails.
void removeInterrupted(MPI_Comm comm, const Directory& directory);

/// Collective. Writes a text to the file `path` on rank 0. Throws Error on all ranks, naming
/// -report_dir, if this fails.
void writeText(MPI_Comm comm, const std::filesystem::path& path, const std::string& text);

}  // namespace squeal::report
