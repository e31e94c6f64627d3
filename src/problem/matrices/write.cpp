// SPDX-License-Identifier: BSD-2-Clause
#include "problem/matrices/write.hpp"

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

#include "algebra/linalg/gathered.hpp"
#include "base/options/options.hpp"
#include "base/options/settings.hpp"
#include "base/output/file.hpp"
#include "base/output/folder.hpp"
#include "base/petsc/object.hpp"
#include "base/session/stages.hpp"
#include "base/system/regular_file.hpp"
#include "base/system/text.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/sweep/sweep.hpp"
#include "problem/matrixfile/formats.hpp"
#include "problem/matrixfile/matrix_market.hpp"

namespace squeal::matrices {

namespace fs = std::filesystem;

namespace {

const char* const heading = "# Matrices of one problem, for squeal -options_file";
std::string errorHead(const ExportSettings& settings) {
  return "option -report_matrices " + settings.folder + ": ";
}

std::string roleOf(const pencil::Term& term) {
  return term.power == 2 ? "mass" : term.power == 1 ? "damping" : "stiffness";
}

/// Returns a name such as "stiffness_friction1", with a number at its end if several terms would
/// have the same name.
std::string nameOf(const pencil::Term& term, std::set<std::string>& taken) {
  std::string name = roleOf(term);
  for (const auto& [word, exponent] : {std::pair{"friction", term.frictionExponent},
                                       {"speed", term.speedExponent},
                                       {"damping", term.dampingExponent}})
    if (exponent != 0) name += formatted("_%s%d", word, exponent);
  std::string unique = name;
  for (int i = 2; !taken.insert(unique).second; ++i) unique = name + formatted("_%d", i);
  return unique;
}

std::string optionsOf(const std::string& name, const pencil::Term& term, const std::string& file) {
  std::string text = optionLine("matrices_" + name + "_file", file) +
                     optionLine("matrices_" + name + "_role", roleOf(term));
  if (term.factor != 1) text += "-matrices_" + name + "_factor " + shortest(term.factor) + "\n";
  for (const auto& [word, exponent] : {std::pair{"friction", term.frictionExponent},
                                       {"speed", term.speedExponent},
                                       {"damping", term.dampingExponent}})
    if (exponent != 0)
      text += formatted("-matrices_%s_%s_exponent %d\n", name.c_str(), word, exponent);
  if (term.ofFriction && term.frictionExponent == 0)
    text += optionLine("matrices_" + name + "_of_friction", "on");
  return text;
}

matrixfile::Entries entriesOf(Mat matrix) {
  matrixfile::Entries entries;
  check(MatGetSize(matrix, &entries.rows, &entries.columns));
  for (PetscInt i = 0; i < entries.rows; ++i) {
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    check(MatGetRow(matrix, i, &count, &columns, &values));
    for (PetscInt k = 0; k < count; ++k) entries.add(i, columns[k], values[k]);
    check(MatRestoreRow(matrix, i, &count, &columns, &values));
  }
  return entries;
}

/// Collective. Writes a matrix: in Matrix Market format if the name ends with .mtx, otherwise in
/// that of PETSc.
void writeMatrix(Mat matrix, const fs::path& path, const std::string& errorHead) {
  const MPI_Comm comm = commOf(matrix);
  if (path.extension() == ".mtx") {
    const OwnedMat whole = linalg::onRankZero(matrix);
    onFirstRank(comm, errorHead, [&] { matrixfile::writeMatrixMarket(path, entriesOf(whole)); });
    return;
  }
  // The file consists of header, row lengths, columns and values. On a full disk PETSc would abort
  // the run with its own message, or hang on ranks other than the first.
  MatInfo info;
  PetscInt rows = 0;
  check(MatGetInfo(matrix, MAT_GLOBAL_SUM, &info));
  check(MatGetSize(matrix, &rows, nullptr));
  const unsigned long long entries = info.nz_used;
  const auto bytes = (4 + entries + rows) * sizeof(PetscInt) + entries * sizeof(PetscScalar);
  onFirstRank(comm, errorHead, [&] { output::reserve(path, bytes); });
  OwnedViewer viewer;
  check(PetscViewerCreate(comm, viewer.out()));
  check(PetscViewerSetType(viewer, PETSCVIEWERBINARY));
  check(PetscViewerFileSetMode(viewer,
                               FILE_MODE_APPEND));  // to the empty file with its reserved space
  check(PetscViewerBinarySkipInfo(viewer));
  check(PetscViewerFileSetName(viewer, path.c_str()));
  check(MatView(matrix, viewer));
}

/// Returns the given options of the stages of a run from matrices, a line each.
std::string carriedOptions() {
  const std::set<std::string> stages{"modes", "flutter"},
      ofMesh{"flutter_pressure", "flutter_friction_damping"};
  std::string text;
  for (const auto& [name, value] : givenOptions()) {
    const auto matches = [&, &name = name](const auto* option) {
      return stages.count(option->stage) && option->matches(name);
    };
    const auto begins = [&, &name = name](const auto* solver) {
      return stages.count(solver->stage) && name.rfind(solver->prefix, 0) == 0;
    };
    const auto options = Option::all();
    const auto solvers = SolverPrefix::all();
    if (!ofMesh.count(name) && (std::any_of(options.begin(), options.end(), matches) ||
                                std::any_of(solvers.begin(), solvers.end(), begins)))
      text += optionLine(name, value);
  }
  return text;
}

void requireOnePencil(const pencil::Pencil& pencil, const sweep::Sweep& sweep,
                      std::size_t steadyPoints) {
  if (steadyPoints != sweep.steadyPoints().size())
    throw Error(
        "option -report_matrices: the contact differs between points of the sweep; export one "
        "-flutter_friction, -flutter_speed and -flutter_pressure at a time");
  if (pencil.terms().size() > pencil.affineCount() && steadyPoints > 1)
    throw Error(
        "option -report_matrices: some matrices depend on the steady state of each point of the "
        "sweep (friction damping, turning "
        "slip); export one -flutter_friction, -flutter_speed and -flutter_pressure at a time");
}

/// Returns true if an export writes a file of this name.
bool isExport(const fs::path& path) {
  static const std::regex matrix(
      R"((mass|damping|stiffness)(_(friction|speed|damping)-?\d+)*(_\d+)?\.(petsc|mtx))");
  return path == "options.txt" || path == output::Manifest::name ||
         std::regex_match(path.string(), matrix);
}

output::Naming naming(const ExportSettings& settings) {
  return {.option = "-report_matrices",
          .last = "options.txt",
          .mayWrite = isExport,
          .ofCase = settings.folderOfCase};
}

}  // namespace

void requireExportFolder(MPI_Comm comm, const ExportSettings& settings, const fs::path& results) {
  const auto place = [](const fs::path& folder) {
    return fs::weakly_canonical(fs::absolute(folder)) / "";
  };
  if (place(results) == place(settings.folder))  // the results have their own options.txt
    throw Error(errorHead(settings) + "is the folder of the results; name another one");
  const output::Folder folder(comm, naming(settings), settings.folder);
}

void exportPencil(const pencil::Pencil& pencil, const ExportSettings& settings,
                  const sweep::Sweep& sweep, std::size_t steadyPoints) {
  requireOnePencil(pencil, sweep, steadyPoints);
  Stage stage(pencil.comm(), "matrices");
  output::Folder folder(pencil.comm(), naming(settings), settings.folder);
  folder.stage();
  const std::string extension = settings.format == ExportFormat::petsc ? ".petsc" : ".mtx";
  std::set<std::string> taken;
  std::string text =
      std::string(heading) + "; the rows are in the order of the run that wrote them\n";
  for (const auto& term : pencil.terms()) {
    const std::string name = nameOf(term, taken);
    const auto path = folder.staging() / (name + extension);
    writeMatrix(term.matrix, path, errorHead(settings));
    text += optionsOf(name, term, path.filename());
  }
  text += carriedOptions();
  onFirstRank(pencil.comm(), errorHead(settings),
              [&] { output::writeFile(folder.staging() / "options.txt", text); });
  folder.commit();
  stage.finish(formatted("%zu matrices in %s", pencil.terms().size(), folder.path().c_str()));
}

}  // namespace squeal::matrices
