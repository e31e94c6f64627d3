#pragma once
/// These functions write the output of a run: tables, fields, the summary and the stability table
/// on the terminal.
#include <filesystem>
#include <string>

#include "analysis/analysis.hpp"
#include "output/folder.hpp"

namespace squeal::report {

/// The folder of a run (`-report_dir`), where new results replace those of an earlier run when all
/// are complete.
class Directory : public output::Folder {
 public:
  /// Collective. Call it when all options have been checked. Throws Error as output::Folder does.
  explicit Directory(MPI_Comm comm);
};

/// Collective. Writes all reports, which then replace those of an earlier run, and prints the
/// stability table. Throws Error, naming -report_dir, if a file cannot be written; the earlier
/// results then stay.
void write(const analysis::Analysis& analysis, Directory& directory);

/// Collective. Writes the file on rank 0. Throws Error on all ranks, naming -report_dir, if that
/// fails.
void writeText(MPI_Comm comm, const std::filesystem::path& path, const std::string& text);

}  // namespace squeal::report
