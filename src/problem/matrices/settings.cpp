// SPDX-License-Identifier: BSD-2-Clause
#include "problem/matrices/settings.hpp"

#include <set>

#include "base/options/options.hpp"
#include "base/options/settings.hpp"
#include "base/petsc/check.hpp"

namespace squeal::matrices {
namespace {

const FileOption fileOption("matrices", "matrices_<name>_file",
                            "file of a matrix of the problem, which replaces the mesh; format: "
                            "Matrix Market, PETSc binary, HDF5 or MATLAB");
const ChoiceOption roleOption("matrices", "matrices_<name>_role", {"mass", "damping", "stiffness"},
                              "",
                              "role of the matrix in the eigenvalue problem; mass: it is "
                              "multiplied by s^2; damping: by s; stiffness: by 1");
const TextOption datasetOption("matrices", "matrices_<name>_dataset", "",
                               "name of the matrix inside a MATLAB or HDF5 file; not needed if the "
                               "file contains only one matrix");
const RealOption factorOption("matrices", "matrices_<name>_factor", 1, "", anyReal,
                              "constant factor on the matrix");
const IntegerOption frictionOption(
    "matrices", "matrices_<name>_friction_exponent", 0, 0, 10,
    "exponent a of the coefficient of friction f: the matrix is multiplied by f^a");
const IntegerOption speedOption(
    "matrices", "matrices_<name>_speed_exponent", 0, -4, 10,
    "exponent b of the speed factor v: the matrix is multiplied by v^b");
const IntegerOption dampingOption(
    "matrices", "matrices_<name>_damping_exponent", 0, 0, 10,
    "exponent d of the damping factor c: the matrix is multiplied by c^d");
const FlagOption ofFrictionOption("matrices", "matrices_<name>_of_friction", false,
                                  "friction with a fixed coefficient in the matrix; on: the matrix "
                                  "is excluded from K0 and M0, whose free modes start the basis");

const TextOption folderOption("report", "report_matrices", "",
                              "folder to which the run exports the matrices of the problem, with "
                              "an options file that solves the problem from them; none: no export");
const ChoiceOption formatOption("report", "report_matrices_format", {"petsc", "matrix_market"},
                                "petsc", "format of the exported matrices");

int powerOf(const std::string& role) { return role == "mass" ? 2 : role == "damping" ? 1 : 0; }

MatrixSettings matrixOf(const std::string& name) {
  return {.file = fileOption.get(name),
          .dataset = datasetOption.get(name),
          .power = powerOf(roleOption.get(name)),
          .factor = factorOption.get(name),
          .frictionExponent = frictionOption.get(name),
          .speedExponent = speedOption.get(name),
          .dampingExponent = dampingOption.get(name),
          .ofFriction = ofFrictionOption.get(name)};
}

/// Throws Error for an option of a name without a file: a misspelt name would leave an option
/// without its matrix.
void rejectOrphans() {
  const auto files = fileOption.subjects();
  const std::set<std::string> known(files.begin(), files.end());
  for (const Option* option : std::initializer_list<const Option*>{
           &roleOption, &datasetOption, &factorOption, &frictionOption, &speedOption,
           &dampingOption, &ofFrictionOption})
    for (const auto& name : option->subjects())
      if (!known.count(name))
        throw Error("option " + option->dashed(name) + ": there is no " + fileOptionOf(name));
}

void rejectMeshOptions() {
  const std::set<std::string> ofMesh{"mesh",       "material", "elasticity", "ground",
                                     "constraint", "load",     "motion",     "friction",
                                     "contact",    "tie",      "steady"};
  const auto reject = [&](const std::string& name) {
    throw Error("option " + name + ": a run uses either a mesh or matrices (" +
                fileOptionOf(fileOption.subjects()[0]) + "), not both");
  };
  for (const auto* option : Option::all()) {
    if (!ofMesh.count(option->stage)) continue;
    for (const auto& subject : option->name.find('<') == std::string::npos
                                   ? std::vector<std::string>{""}
                                   : option->subjects())
      if (option->given(subject)) reject(option->dashed(subject));
  }
  for (const auto* solver : SolverPrefix::all())
    if (ofMesh.count(solver->stage) && solver->given()) reject(solver->names()[0]);
}

}  // namespace

std::string fileOptionOf(const std::string& name) { return fileOption.dashed(name); }

ExportSettings ExportSettings::given() {
  ExportSettings settings{.folder = folderOption.get()};
  if (!settings.wanted()) return settings;
  settings.folderOfCase = !origin("report_matrices", settings.folder).file.empty();
  if (formatOption.get() == "matrix_market") settings.format = ExportFormat::matrixMarket;
  return settings;
}

Settings Settings::given() {
  rejectOrphans();
  Settings settings;
  const auto names = fileOption.subjects();
  if (names.empty()) return settings;
  rejectMeshOptions();
  for (const auto& name : names) settings.files.emplace(name, matrixOf(name));
  return settings;
}

}  // namespace squeal::matrices
