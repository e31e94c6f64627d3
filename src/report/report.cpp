#include "report/report.hpp"

#include <system_error>

#include "petsc/options.hpp"
#include "petsc/stages.hpp"
#include "petsc/text.hpp"

namespace squeal::report {
namespace {

const TextOption directoryOption("report", "report_dir", "results",
                                 "folder for the results; those of an earlier run in it are replaced");
const FlagOption fieldsOption("report", "report_fields", true, "write fields: results.h5 and the VTK files");

/// Names that a run makes; nothing else in the folder is touched.
bool isResult(const std::filesystem::path& name) {
  const std::string text = name.filename().string();
  const auto begins = [&](const char* start) { return text.rfind(start, 0) == 0; };
  return text == "eigenvalues.csv" || text == "branches.csv" || text == "critical.csv" || text == "modes.csv" ||
         text == "summary.json" || text == "results.h5" || text == "options.txt" || text == "sensitivities.csv" ||
         text == "friction_work.csv" || text == "stability_map.csv" || text == "vtk" || text == ".partial" ||
         (begins("stability") && name.extension() == ".png") || (begins("steady_") && name.extension() == ".csv") ||
         (begins("modes_") && name.extension() == ".csv");
}

}  // namespace

Directory::Directory(MPI_Comm comm) : comm_(comm), path_(directoryOption.get()), staging_(path_ / ".partial") {
  onFirstRank(comm, "option -report_dir: ", [&] {
    std::filesystem::create_directories(path_);
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      if (isResult(entry.path())) std::filesystem::remove_all(entry.path());
    std::filesystem::create_directories(staging_);
  });
}

Directory::~Directory() {
  int rank = 0;
  MPI_Comm_rank(comm_, &rank);
  std::error_code ignored;
  if (rank == 0) std::filesystem::remove_all(staging_, ignored);
}

void Directory::commit() const {
  onFirstRank(comm_, "option -report_dir: ", [&] {
    std::vector<std::filesystem::path> names;
    for (const auto& entry : std::filesystem::directory_iterator(staging_))
      if (entry.path().filename() != "summary.json") names.push_back(entry.path().filename());
    names.push_back("summary.json");
    for (const auto& name : names) std::filesystem::rename(staging_ / name, path_ / name);
  });
}

std::string pointName(const Parameters& at) {
  std::string name = shortest(at.friction);
  for (const auto& parameter : allParameters)
    if (parameter.value != &Parameters::friction && at.*parameter.value != 1)
      name += "_" + std::string(parameter.name) + "_" + shortest(at.*parameter.value);
  return name;
}

void write(const Analysis& analysis, const Directory& directory) {
  const MPI_Comm comm = analysis.comm;
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
