#include "report/report.hpp"

#include <memory>

#include "options/options.hpp"
#include "output/file.hpp"
#include "report/fields.hpp"
#include "report/names.hpp"
#include "report/summary.hpp"
#include "report/tables.hpp"
#include "session/stages.hpp"
#include "sweep/sweep.hpp"

namespace squeal::report {
namespace {

const TextOption directoryOption("report", "report_dir", "results",
                                 "folder for the results; those of an earlier run in it are "
                                 "replaced when the new ones are complete");
const FlagOption fieldsOption("report", "report_fields", true,
                              "write fields: results.h5 and the VTK files");

output::Naming naming() {
  const auto names = std::make_shared<ResultNames>(sweep::readSweep().points());
  return {folderOption, "summary.json",
          [names](const std::filesystem::path& path) { return names->contains(path); },
          formerResults};
}

}  // namespace

Directory::Directory(MPI_Comm comm) : Folder(comm, naming(), directoryOption.get()) {}

void writeText(MPI_Comm comm, const std::filesystem::path& path, const std::string& text) {
  onFirstRank(comm, std::string("option ") + folderOption + ": ",
              [&] { output::writeFile(path, text); });
}

void write(const analysis::Analysis& analysis, Directory& directory) {
  const MPI_Comm comm = analysis.comm;
  directory.stage();
  {
    Stage stage(comm, "report");
    writeTables(analysis, directory.staging());
    if (fieldsOption.get()) {
      writeHdf5(analysis, directory.staging());
      if (analysis.mesh) writeFields(analysis, directory.staging());
    }
    stage.finish("results in " + directory.path().string());
  }
  writeRecipe(analysis, directory.staging());
  writeSummary(analysis, directory.staging());  // after the last stage: it holds the times
  directory.commit();
  say(comm, stabilityTable(analysis));
}

}  // namespace squeal::report
