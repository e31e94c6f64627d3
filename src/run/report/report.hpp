#pragma once
/// These functions write the output of a run: tables, fields, the summary and the stability table
/// on the terminal.
#include <filesystem>
#include <string>

#include "base/output/folder.hpp"
#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// The folder of a run (`-report_dir`), where new results replace those of an earlier run when all
/// are complete.
class Directory : public output::Folder {
 public:
  /// Collective. Call it when all settings have been read: it writes them to options.txt in
  /// staging(), so that a run that is killed leaves them. Throws Error as output::Folder does.
  explicit Directory(MPI_Comm comm);
  /// Returns the folder inside it for what a run leaves that has been asked to stop.
  std::filesystem::path interrupted() const { return path() / "interrupted"; }
};

/// Collective. Writes all reports, which then replace those of an earlier run, and prints the
/// stability table. Those of a run that has been asked to stop go to interrupted() instead, and the
/// results of an earlier run stay; there are none if no eigenvalue has been found. Throws Error,
/// naming -report_dir, if a file cannot be written; the earlier results then stay.
void write(const analysis::Analysis& analysis, Directory& directory);

/// Collective. Removes the results of an interrupted run in interrupted(), except its checkpoint. A
/// failure is a warning.
void removeInterrupted(MPI_Comm comm, const Directory& directory);

/// Collective. Writes the file on rank 0. Throws Error on all ranks, naming -report_dir, if that
/// fails.
void writeText(MPI_Comm comm, const std::filesystem::path& path, const std::string& text);

}  // namespace squeal::report
