#pragma once
/// The output of a run: tables, fields, the summary and the stability table on the terminal.
#include <filesystem>

#include "analysis/analysis.hpp"
#include "output/folder.hpp"
#include "report/names.hpp"

namespace squeal::report {

/// The folder of a run (`-report_dir`), where new results replace those of an earlier run when all
/// are complete.
class Directory : public output::Folder {
 public:
  /// Collective. Call it when all options have been checked. Throws Error as output::Folder does.
  explicit Directory(MPI_Comm comm);
};

/// Collective. Writes all reports and prints the stability table.
void write(const analysis::Analysis& analysis, Directory& directory);

/// Collective. Writes the file on rank 0. Throws Error on all ranks, naming -report_dir, if that
/// fails.
void writeText(MPI_Comm comm, const std::filesystem::path& path, const std::string& text);

/// The parts of write(), each collective, into `folder`.
void writeTables(const analysis::Analysis& analysis, const std::filesystem::path& folder);
/// options.txt; after all else, when every option has been asked for.
void writeRecipe(const analysis::Analysis& analysis, const std::filesystem::path& folder);
void writeSummary(const analysis::Analysis& analysis, const std::filesystem::path& folder);
void writeHdf5(const analysis::Analysis& analysis, const std::filesystem::path& folder);
void writeFields(const analysis::Analysis& analysis, const std::filesystem::path& folder);
/// Returns the derivatives of the eigenvalues of the complex modes kept, with a row per mode and
/// parameter; a mode without derivatives has one row, "none".
std::string sensitivityTable(const analysis::Analysis& analysis);
/// Collective. Returns the contribution of friction on each interface to the growth rates of the
/// complex modes kept (flutter::frictionWork).
std::string frictionWorkTable(const analysis::Analysis& analysis);
/// branches.csv, critical.csv, and what the terminal says of both.
std::string branchTable(const analysis::Analysis& analysis);
std::string criticalTable(const analysis::Analysis& analysis);
std::string followedText(const analysis::Analysis& analysis);
/// Returns the frequencies and growth rates of the unstable modes at each friction.
std::string stabilityTable(const analysis::Analysis& analysis);

}  // namespace squeal::report
