#include "run/report/report.hpp"

#include <algorithm>
#include <memory>

#include "base/options/options.hpp"
#include "base/options/settings.hpp"
#include "base/output/file.hpp"
#include "base/session/events.hpp"
#include "base/session/stages.hpp"
#include "eigen/sweep/sweep.hpp"
#include "run/report/fields.hpp"
#include "run/report/names.hpp"
#include "run/report/recipe.hpp"
#include "run/report/stability_table.hpp"
#include "run/report/summary.hpp"
#include "run/report/tables.hpp"

namespace squeal::report {
namespace {

const TextOption directoryOption("report", "report_dir", "results",
                                 "folder for the results: a new or empty one, or one with earlier "
                                 "results, which are replaced when the new ones are complete");
const FlagOption fieldsOption("report", "report_fields", true,
                              "write fields: results.h5 and the VTK files");

/// Returns true if a case names the folder: in an options file, or, as scripts/run does it, by its
/// own name: results/NAME for the case NAME.yaml.
bool isOfCase(const std::filesystem::path& folder) {
  if (!origin("report_dir", folder.string()).file.empty()) return true;
  const auto place = (std::filesystem::absolute(folder) / "").lexically_normal().parent_path();
  if (place.parent_path().filename() != "results") return false;
  return std::ranges::any_of(givenOptions(), [&](const auto& option) {
    const std::filesystem::path file = origin(option.first, option.second).file;
    return !file.empty() && file.stem() == place.filename();
  });
}

output::Naming naming() {
  const auto names = std::make_shared<ResultNames>(sweep::grid(sweep::Settings::given()).points());
  const std::filesystem::path part = "interrupted";
  return {.option = folderOption,
          .last = "summary.json",
          .mayWrite = [names](const std::filesystem::path& path) { return names->contains(path); },
          .marks = {part / output::Manifest::name, part / "checkpoint" / "identity.json"}};
}

/// Returns the naming of the folder that the option names.
output::Naming namingOfOption() {
  output::Naming naming = report::naming();
  naming.ofCase = isOfCase(directoryOption.get());
  if (const auto log = eventsFile(); !log.empty()) naming.opened = {log};
  return naming;
}

/// Returns the naming of a folder inside it.
output::Naming namingOfPart() {
  output::Naming naming = report::naming();
  naming.inside = true;
  return naming;
}

/// Collective. Writes all reports into the folder, which has been staged.
void writeInto(const analysis::Analysis& analysis, output::Folder& folder) {
  {
    Stage stage(analysis.comm, "report");
    writeTables(analysis, folder.staging());
    if (fieldsOption.get()) {
      writeHdf5(analysis, folder.staging());
      if (analysis.mesh) writeFields(analysis, folder.staging());
    }
    stage.finish("results in " + folder.path().string());
  }
  writeRecipe(analysis.comm, folder.staging());
  writeSummary(analysis, folder.staging());  // after the last stage: it holds the times
  folder.commit();
}

}  // namespace

Directory::Directory(MPI_Comm comm) : Folder(comm, namingOfOption(), directoryOption.get()) {
  stage();
  writeRecipe(comm, staging());
}

void writeText(MPI_Comm comm, const std::filesystem::path& path, const std::string& text) {
  onFirstRank(comm, std::string("option ") + folderOption + ": ",
              [&] { output::writeFile(path, text); });
}

void write(const analysis::Analysis& analysis, Directory& directory) {
  const MPI_Comm comm = analysis.comm;
  if (!analysis.interrupted) {
    writeInto(analysis, directory);
    say(comm, stabilityTable(analysis));
    return;
  }
  const std::string how = analysis.checkpoint.exists() ? "; -resume continues it" : "";
  if (analysis.segments.empty()) {
    removeInterrupted(comm,
                      directory);  // tables of an earlier run, beside a checkpoint of this one
    return complain(comm, "interrupted before the first eigenvalues" + how);
  }
  try {
    output::Folder part(comm, namingOfPart(), directory.interrupted());
    part.stage();
    writeInto(analysis, part);
  } catch (const Error& error) {
    return complain(comm, std::string("interrupted; what was found so far is not written: ") +
                              error.what() + how);
  }
  say(comm, stabilityTable(analysis));
  complain(comm,
           "interrupted: what was found so far is in " + directory.interrupted().string() + how);
}

void removeInterrupted(MPI_Comm comm, const Directory& directory) {
  bool there = false;
  onFirstRank(comm, "", [&] {
    there = std::filesystem::is_directory(std::filesystem::symlink_status(directory.interrupted()));
  });
  mpi::broadcast(comm, there);
  if (there) try {
      output::Folder(comm, namingOfPart(), directory.interrupted()).discard();
    } catch (const Error& error) {  // the results are complete
      complain(comm, std::string("warning: results of an interrupted run stay: ") + error.what());
    }
}

}  // namespace squeal::report
