#include "problem/matrices/matrices.hpp"

#include <set>

#include "base/options/options.hpp"
#include "base/session/stages.hpp"
#include "base/system/text.hpp"
#include "eigen/pencil/pencil.hpp"
#include "problem/matrices/read.hpp"

namespace squeal::matrices {
namespace {

const FileOption fileOption(
    "matrices", "matrices_<name>_file",
    "a matrix of the problem: Matrix Market, PETSc binary, HDF5 or MATLAB file; instead of a mesh");
const ChoiceOption roleOption("matrices", "matrices_<name>_role", {"mass", "damping", "stiffness"},
                              "", "the power of s that the matrix comes with: 2, 1, 0");
const TextOption datasetOption(
    "matrices", "matrices_<name>_dataset", "",
    "variable of a MATLAB file or object of an HDF5 file; none: the only matrix there");
const RealOption factorOption("matrices", "matrices_<name>_factor", 1, "", anyReal,
                              "factor on the matrix");
const IntegerOption frictionOption(
    "matrices", "matrices_<name>_friction_exponent", 0, 0, 10,
    "power of the coefficient of friction that the matrix is multiplied by");
const IntegerOption speedOption("matrices", "matrices_<name>_speed_exponent", 0, -4, 10,
                                "power of the speed factor that the matrix is multiplied by");
const IntegerOption dampingOption("matrices", "matrices_<name>_damping_exponent", 0, 0, 10,
                                  "power of the damping factor that the matrix is multiplied by");
const FlagOption ofFrictionOption(
    "matrices", "matrices_<name>_of_friction", false,
    "it holds a friction that is not swept: part of the problem, but not of K0 and M0, whose free "
    "modes begin the basis");

int powerOf(const std::string& role) { return role == "mass" ? 2 : role == "damping" ? 1 : 0; }

NamedTerm readTerm(MPI_Comm comm, const std::string& name) {
  pencil::Term term;
  term.power = powerOf(roleOption.get(name));
  term.frictionExponent = frictionOption.get(name);
  term.factor = factorOption.get(name);
  term.speedExponent = speedOption.get(name);
  term.dampingExponent = dampingOption.get(name);
  term.ofFriction = ofFrictionOption.get(name);
  try {
    term.matrix = read(comm, fileOption.get(name), datasetOption.get(name));
  } catch (const Error& error) {
    throw Error("option -" + fileOption.fullName(name) + ": " + error.what());
  }
  // Rounding alone: what is symmetric is projected at half the price.
  if (asymmetry(term.matrix) < 1e-15) check(MatSetOption(term.matrix, MAT_SYMMETRIC, PETSC_TRUE));
  return {name, std::move(term)};
}

void requireEqualSizes(const std::vector<NamedTerm>& terms) {
  PetscInt wanted = 0, size = 0;
  check(MatGetSize(terms.at(0).term.matrix, &wanted, nullptr));
  for (const auto& [name, term] : terms) {
    check(MatGetSize(term.matrix, &size, nullptr));
    if (size != wanted)
      throw Error(
          formatted("option -%s: %" PetscInt_FMT " rows, but matrix '%s' has %" PetscInt_FMT,
                    fileOption.fullName(name).c_str(), size, terms[0].name.c_str(), wanted));
  }
}

/// Throws Error for an option of a name without a file: a misspelt name would leave an option
/// without its matrix.
void rejectOrphans() {
  const auto files = fileOption.subjects();
  const std::set<std::string> known(files.begin(), files.end());
  const auto requireFile = [&](const Option& option) {
    for (const auto& name : option.subjects())
      if (!known.count(name))
        throw Error("option -" + option.fullName(name) + ": there is no -" +
                    fileOption.fullName(name));
  };
  requireFile(roleOption);
  requireFile(datasetOption);
  requireFile(factorOption);
  requireFile(frictionOption);
  requireFile(speedOption);
  requireFile(dampingOption);
  requireFile(ofFrictionOption);
}

void rejectMeshOptions() {
  const std::set<std::string> ofMesh{"mesh",   "elasticity", "constraint", "load",
                                     "motion", "contact",    "tie",        "steady"};
  const auto complain = [&](const std::string& name) {
    throw Error("option -" + name + ": a run is of a mesh or of matrices (-" +
                fileOption.fullName(fileOption.subjects()[0]) + "), not of both");
  };
  for (const auto* option : Option::all()) {
    if (!ofMesh.count(option->stage)) continue;
    for (const auto& subject : option->name.find('<') == std::string::npos
                                   ? std::vector<std::string>{""}
                                   : option->subjects())
      if (option->given(subject)) complain(option->fullName(subject));
  }
  for (const auto* solver : SolverPrefix::all())
    if (ofMesh.count(solver->stage) && solver->given()) complain(solver->names()[0].substr(1));
}

}  // namespace

bool wanted() {
  rejectOrphans();
  if (fileOption.subjects().empty()) return false;
  rejectMeshOptions();
  return true;
}

std::vector<NamedTerm> readTerms(MPI_Comm comm) {
  std::vector<NamedTerm> terms;
  for (const auto& name : fileOption.subjects()) terms.push_back(readTerm(comm, name));
  requireEqualSizes(terms);
  return terms;
}

double asymmetry(Mat matrix) {
  OwnedMat difference;
  PetscReal size = 0, departure = 0;
  check(MatNorm(matrix, NORM_FROBENIUS, &size));
  if (size == 0) return 0;
  check(MatTranspose(matrix, MAT_INITIAL_MATRIX, difference.out()));
  check(MatAXPY(difference, -1, matrix, DIFFERENT_NONZERO_PATTERN));
  check(MatNorm(difference, NORM_FROBENIUS, &departure));
  return departure / size;
}

}  // namespace squeal::matrices
