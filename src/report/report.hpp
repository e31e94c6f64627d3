#pragma once
/// What a run leaves behind: tables, fields, the summary and the terminal's stability table.
#include <filesystem>

#include "analysis.hpp"

namespace squeal::report {

/// The folder of a run (`-report_dir`). Results of an earlier run are removed when it is opened; new ones appear under their names
/// only when all are complete, so that what lies there is always one whole run.
class Directory {
 public:
  /// Collective. Makes the folder. Error: it cannot be made or written.
  explicit Directory(MPI_Comm comm);
  ~Directory();
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
  /// Where files are written until commit().
  const std::filesystem::path& staging() const { return staging_; }
  /// Collective. Moves everything into the folder, summary.json last.
  void commit() const;
  const std::filesystem::path& path() const { return path_; }

 private:
  MPI_Comm comm_;
  std::filesystem::path path_, staging_;
};

/// Collective. Writes all reports and prints the stability table.
void write(const Analysis& analysis, const Directory& directory);

/// A point of the sweep as it stands in file and group names: FRICTION, and _speed_SPEED, _pressure_… of the factors that are not 1.
std::string pointName(const Parameters& at);

/// The parts of write(), each collective, into `folder`.
void writeTables(const Analysis& analysis, const std::filesystem::path& folder);
/// options.txt; after all else, when every option has been asked for.
void writeRecipe(const Analysis& analysis, const std::filesystem::path& folder);
void writeSummary(const Analysis& analysis, const std::filesystem::path& folder);
void writeHdf5(const Analysis& analysis, const std::filesystem::path& folder);
void writeFields(const Analysis& analysis, const std::filesystem::path& folder);
/// Derivatives of the eigenvalues of the complex modes kept: a row per mode and parameter; a mode without any has one row, "none".
std::string sensitivityTable(const Analysis& analysis);
/// Collective. What friction on each interface adds to the growth rates of the complex modes kept (flutter::frictionWork).
std::string frictionWorkTable(const Analysis& analysis);
/// branches.csv, critical.csv, and what the terminal says of both.
std::string branchTable(const Analysis& analysis);
std::string criticalTable(const Analysis& analysis);
std::string followedText(const Analysis& analysis);
/// Frequencies and growth rates of the unstable modes at each friction.
std::string stabilityTable(const Analysis& analysis);

}  // namespace squeal::report
