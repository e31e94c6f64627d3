// SPDX-License-Identifier: BSD-2-Clause
#include "steady/steady/complementarity.hpp"

#include <algorithm>

#include "base/options/options.hpp"
#include "base/petsc/arrays.hpp"
#include "base/system/text.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::steady {
namespace {

const SolverPrefix solverPrefix(
    "steady", "steady_",
    "options of PETSc's SNES VI, KSP and PC for steady sliding: snes_*, ksp_*, pc_*, …");

bool isGiven(const std::string& option) {
  PetscBool given = PETSC_FALSE;
  check(PetscOptionsHasName(nullptr, nullptr, option.c_str(), &given));
  return given;
}

/// Sets the default of an option while SNES reads its options, unless the user has given the
/// option. PETSc has no function for this value.
class DefaultOption {
 public:
  DefaultOption(std::string name, const char* value) : name_(std::move(name)) {
    if (isGiven(name_))
      name_.clear();
    else
      check(PetscOptionsSetValue(nullptr, name_.c_str(), value));
  }
  ~DefaultOption() {
    if (!name_.empty()) check(PetscOptionsClearValue(nullptr, name_.c_str()));
  }
  DefaultOption(const DefaultOption&) = delete;
  DefaultOption& operator=(const DefaultOption&) = delete;

 private:
  std::string name_;
};

/// The problem scaled for SNES, so tolerances do not depend on units:
///   F̂(x̂) = F(x)/forceUnit,   x = xUnit x̂.
struct Scaled {
  const Problem& problem;
  sweep::Parameters at;
  double xUnit, forceUnit;
  bool nonlinear;
  Vec x;  // work
};

PetscErrorCode evaluate(SNES, Vec x, Vec f, void* context) {
  const auto& scaled = *static_cast<const Scaled*>(context);
  PetscFunctionBegin;
  PetscCall(VecCopy(x, scaled.x));
  PetscCall(VecScale(scaled.x, scaled.xUnit));
  scaled.problem.residual(scaled.at, scaled.x, f);
  PetscCall(VecScale(f, 1 / scaled.forceUnit));
  PetscFunctionReturn(0);
}

PetscErrorCode differentiate(SNES, Vec x, Mat jacobian, Mat, void* context) {
  const auto& scaled = *static_cast<const Scaled*>(context);
  PetscFunctionBegin;
  if (!scaled.nonlinear) PetscFunctionReturn(0);
  PetscCall(VecCopy(x, scaled.x));
  PetscCall(VecScale(scaled.x, scaled.xUnit));
  const OwnedMat fresh = scaled.problem.jacobian(scaled.at, scaled.x);
  PetscCall(MatCopy(fresh, jacobian, SAME_NONZERO_PATTERN));
  PetscCall(MatScale(jacobian, scaled.xUnit / scaled.forceUnit));
  PetscFunctionReturn(0);
}

}  // namespace

double naturalResidual(const Problem& problem, const sweep::Parameters& at, Vec x) {
  const OwnedVec f = rightVector(problem.transformation().trial);
  problem.residual(at, x, f);
  PetscInt first = 0;
  check(VecGetOwnershipRange(x, &first, nullptr));
  {
    const ReadArray gaps(x);
    const WriteArray values(f);
    const auto& columns = problem.transformation().gapColumn;
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (double& force = values[columns[i] - first]; gaps[columns[i] - first] <= 0)
        force = problem.contact().interfaces.nodes[i].separates ? std::min(force, 0.0) : 0;
  }
  PetscReal size = 0;
  check(VecNorm(f, NORM_2, &size));
  return size;
}

Accuracy accuracyNear(const Problem& problem, const sweep::Parameters& at, Vec x) {
  Accuracy accuracy;
  const Mat trial = problem.transformation().trial;
  const OwnedVec zero = rightVector(trial), start = rightVector(trial);
  problem.residual(at, zero, start);
  check(VecNorm(start, NORM_2, &accuracy.forceUnit));
  if (accuracy.forceUnit == 0) accuracy.forceUnit = 1;
  // The residual cannot become smaller than round-off, which grows with the displacements and with
  // the number of unknowns.
  const double rounding = problem.rounding(problem.displacement(at, x), problem.load(at));
  accuracy.target = std::max(1e-11, 10 * rounding / accuracy.forceUnit);
  return accuracy;
}

OwnedSNES newSnes(MPI_Comm comm, double target) {
  OwnedSNES snes;
  check(SNESCreate(comm, snes.out()));
  check(SNESSetOptionsPrefix(snes, solverPrefix.prefix.c_str()));
  check(SNESSetType(snes, SNESVINEWTONRSLS));
  check(SNESSetTolerances(snes, target, 1e-14, 0, 30, 1000));
  // Newton's method corrects the error of a linear solve that stagnates; the residual decides.
  check(SNESSetMaxLinearSolveFailures(snes, 1000));
  return snes;
}

bool solveSnes(SNES snes, Vec x, Solution& solution) {
  {
    // Even a tiny gap is open. The default, 1e-8 of the largest displacement, is too large if a
    // body moves far as a whole.
    const DefaultOption exact("-" + solverPrefix.prefix + "snes_vi_zero_tolerance", "1e-14");
    applySolverOptions([&] { return SNESSetFromOptions(snes); });
  }
  // SNES reads these options only while it solves.
  solverPrefix.rejectUnused(
      {"mat_mumps_", "uniqueness_", "snes_test_jacobian", "snes_converged_reason", "snes_view"});
  applySolverOptions([&] { return SNESSolve(snes, nullptr, x); });  // the solve sets up its parts
  SNESConvergedReason reason;
  PetscInt iterations = 0;
  check(SNESGetConvergedReason(snes, &reason));
  check(SNESGetIterationNumber(snes, &iterations));
  check(SNESGetTolerances(snes, &solution.tolerance, nullptr, nullptr, nullptr, nullptr));
  solution.reason = SNESConvergedReasons[reason];
  solution.iterations += iterations;
  return reason > 0;
}

void accept(Solution& solution, double left, const Accuracy& accuracy) {
  const double accepted = std::max(solution.tolerance, 10 * accuracy.target);
  solution.residual = left / accuracy.forceUnit;
  solution.converged = solution.residual <= accepted;
  // The reason of a solver that has converged for its own function would contradict the residual.
  if (!solution.converged && !solution.reason.starts_with("DIVERGED"))
    solution.reason = formatted(
        "the solver of the contact stopped at a relative residual of all equations of %.2g, above "
        "the accepted %.2g%s",
        solution.residual, accepted,
        solution.reason.empty() ? "" : (" (" + solution.reason + ")").c_str());
}

/// Makes GMRES solve each Newton step, with the Cholesky factor of the frictionless matrix as
/// preconditioner.
static void setStepSolver(SNES snes) {
  KSP ksp = nullptr;
  PC pc = nullptr;
  check(SNESGetKSP(snes, &ksp));
  check(KSPSetType(ksp, KSPGMRES));
  check(KSPSetTolerances(ksp, 1e-10, PETSC_DEFAULT, PETSC_DEFAULT, 100));
  check(KSPGMRESSetRestart(ksp, 100));
  check(KSPGetPC(ksp, &pc));
  check(PCSetType(pc, PCCHOLESKY));
  check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  check(KSPSetPCSide(ksp, PC_RIGHT));
}

double complementarity(const Problem& problem, OwnedVec& x, Solution& solution) {
  const contact::Transformation& transformation = problem.transformation();
  PetscReal xUnit = 0;
  check(VecNorm(x, NORM_INFINITY, &xUnit));
  if (xUnit == 0) xUnit = 1;
  const Accuracy accuracy = accuracyNear(problem, solution.at, x);
  const OwnedMat jacobian = problem.jacobian(solution.at, x);
  OwnedMat symmetric;
  check(MatDuplicate(problem.stiffness().matrix, MAT_COPY_VALUES, symmetric.out()));
  for (Mat matrix : {jacobian.get(), symmetric.get()})
    check(MatScale(matrix, xUnit / accuracy.forceUnit));
  check(VecScale(x, 1 / xUnit));
  const OwnedVec work = rightVector(jacobian);
  Scaled scaled{problem,
                solution.at,
                xUnit,
                accuracy.forceUnit,
                problem.contact().sliding.convected != nullptr,
                work};

  const OwnedVec low = rightVector(jacobian), high = rightVector(jacobian);
  check(VecSet(low, PETSC_NINFINITY));
  check(VecSet(high, PETSC_INFINITY));
  for (std::size_t i = 0; i < transformation.gapColumn.size(); ++i) {
    check(VecSetValue(low, transformation.gapColumn[i], 0, INSERT_VALUES));
    if (!problem.contact().interfaces.nodes[i].separates)
      check(VecSetValue(high, transformation.gapColumn[i], 0, INSERT_VALUES));
  }
  for (const Vec bound : {low.get(), high.get()}) {
    check(VecAssemblyBegin(bound));
    check(VecAssemblyEnd(bound));
  }

  const auto solve = [&] {
    const OwnedSNES snes = newSnes(problem.mesh().comm, accuracy.target);
    const OwnedVec value = rightVector(jacobian);
    check(SNESSetFunction(snes, value, evaluate, &scaled));
    check(SNESSetJacobian(snes, jacobian, symmetric, differentiate, &scaled));
    check(SNESVISetVariableBounds(snes, low, high));
    setStepSolver(snes);
    return solveSnes(snes, x, solution);
  };
  const OwnedVec start = rightVector(jacobian);
  check(VecCopy(x, start));
  const std::string lineSearch = "-" + solverPrefix.prefix + "snes_linesearch_type";
  if (!solve() && !isGiven(lineSearch)) {
    // If only the contact supports a body, the first steps must pass through states with larger
    // residuals, which the line search rejects.
    const std::string searched = solution.reason;
    const DefaultOption fullSteps(lineSearch, "basic");
    check(VecCopy(start, x));
    if (!solve()) solution.reason = searched + ", in full steps " + solution.reason;
  }
  check(VecScale(x, xUnit));
  const double left = naturalResidual(problem, solution.at, x);
  accept(solution, left, accuracy);
  return left;
}

}  // namespace squeal::steady
