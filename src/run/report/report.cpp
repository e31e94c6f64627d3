// SPDX-License-Identifier: BSD-2-Clause
#include "run/report/report.hpp"

#include <memory>

#include "base/output/file.hpp"
#include "base/session/stages.hpp"
#include "run/audit/audit.hpp"
#include "run/report/fields.hpp"
#include "run/report/judgement.hpp"
#include "run/report/names.hpp"
#include "run/report/recipe.hpp"
#include "run/report/stability_table.hpp"
#include "run/report/summary.hpp"
#include "run/report/tables.hpp"

namespace squeal::report {
namespace {

output::Naming naming(const std::vector<sweep::Parameters>& points) {
  const auto names = std::make_shared<ResultNames>(points);
  const std::filesystem::path part = "interrupted";
  return {.option = folderOption,
          .last = "summary.json",
          .mayWrite = [names](const std::filesystem::path& path) { return names->contains(path); },
          .marks = {part / output::Manifest::name, part / "checkpoint" / "identity.json"}};
}

/// Returns the naming of the results folder.
output::Naming namingOfOption(const Settings& settings,
                              const std::vector<sweep::Parameters>& points) {
  output::Naming naming = report::naming(points);
  naming.ofCase = settings.folderOfCase;
  if (!settings.eventLog.empty()) naming.opened = {settings.eventLog};
  return naming;
}

/// Returns the naming of a subfolder of the results folder.
output::Naming namingOfPart(const std::vector<sweep::Parameters>& points) {
  output::Naming naming = report::naming(points);
  naming.inside = true;
  return naming;
}

/// Collective. Writes all reports into the folder, which must be staged and contain the recipe.
void writeInto(const analysis::Analysis& analysis, const Settings& settings,
               output::Folder& folder) {
  {
    Stage stage(analysis.comm, "report");
    writeTables(analysis, folder.staging());
    if (analysis.audit)
      writeText(analysis.comm, folder.staging() / "audit.md", audit::markdown(*analysis.audit));
    if (settings.fields) {
      writeHdf5(analysis, folder.staging());
      if (analysis.model.mesh) writeFields(analysis, settings, folder.staging());
    }
    stage.finish("results in " + folder.path().string());
  }
  writeSummary(analysis, folder.staging());  // after the last stage, since it contains the times
  folder.commit();
}

}  // namespace

Directory::Directory(MPI_Comm comm, const Settings& settings, std::vector<sweep::Parameters> points)
    : Folder(comm, namingOfOption(settings, points), settings.folder), points_(std::move(points)) {
  stage();
  writeRecipe(comm, staging());
}

void writeText(MPI_Comm comm, const std::filesystem::path& path, const std::string& text) {
  onFirstRank(comm, std::string("option ") + folderOption + ": ",
              [&] { output::writeFile(path, text); });
}

void write(const analysis::Analysis& analysis, const Settings& settings, Directory& directory) {
  const MPI_Comm comm = analysis.comm;
  const std::string note = settings.note.empty() ? "" : "\nNote: " + settings.note;
  if (!analysis.interrupted()) {
    writeInto(analysis, settings, directory);
    printLine(comm, stabilityTable(analysis) +
                        (analysis.judged ? refereeText(*analysis.judged) : "") + note);
    return;
  }
  const std::string how = analysis.checkpoint.exists() ? "; -resume continues it" : "";
  if (analysis.flutter.segments.empty()) {
    removeInterrupted(comm,
                      directory);  // tables of an earlier run, next to a checkpoint of this one
    return printWarning(comm, "interrupted before the first eigenvalues" + how);
  }
  try {
    output::Folder part(comm, namingOfPart(directory.points()), directory.interrupted());
    part.stage();
    writeRecipe(comm, part.staging());
    writeInto(analysis, settings, part);
  } catch (const Error& error) {
    return printWarning(comm, std::string("interrupted; the results so far cannot be written: ") +
                                  error.what() + how);
  }
  printLine(comm, stabilityTable(analysis) + note);
  printWarning(comm,
               "interrupted: the results so far are in " + directory.interrupted().string() + how);
}

void removeInterrupted(MPI_Comm comm, const Directory& directory) {
  bool there = false;
  onFirstRank(comm, "", [&] {
    there = std::filesystem::is_directory(std::filesystem::symlink_status(directory.interrupted()));
  });
  mpi::broadcast(comm, there);
  if (there) try {
      output::Folder(comm, namingOfPart(directory.points()), directory.interrupted()).discard();
    } catch (const Error& error) {  // the results are complete
      printWarning(comm, std::string("warning: cannot remove the results of an interrupted run: ") +
                             error.what());
    }
}

}  // namespace squeal::report
