// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/factor/symmetric_solver.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include "base/petsc/object.hpp"
#include "base/session/stages.hpp"
#include "base/system/mpi.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"

namespace squeal::factor {
namespace {

const SolverPrefix factorisation(
    "modes", solverPrefix,
    "options of SLEPc's ST and PETSc's KSP and PC for the factorisation of K (MUMPS LDLt): "
    "st_type, ksp_*, pc_*, mat_mumps_*, …");

/// The context of a PCSHELL: the factor and its state.
struct Shell {
  std::unique_ptr<MumpsFactor> factor;
  Mat matrix = nullptr;  // of the analysis
  PetscObjectState pattern = -1;
  std::string failure;        // of the last factorisation
  std::exception_ptr thrown;  // it must not pass through the C code of PETSc
};

Shell* shellOf(PC pc) {
  Shell* shell = nullptr;
  check(PCShellGetContext(pc, &shell));
  return shell;
}

PetscErrorCode setUp(PC pc) {
  Shell& shell = *shellOf(pc);
  try {
    Mat matrix = nullptr;
    PetscObjectState pattern = 0;
    check(PCGetOperators(pc, nullptr, &matrix));
    check(MatGetNonzeroState(matrix, &pattern));
    shell.thrown = nullptr;
    if (matrix != shell.matrix || pattern != shell.pattern) shell.factor->analyse(matrix);
    shell.matrix = matrix;
    shell.pattern = pattern;
    shell.failure = shell.factor->factorise(matrix);
  } catch (...) {
    shell.thrown = std::current_exception();
  }
  return 0;
}

/// Solves, and ends the run on failure (full memory or disk), since an exception must not pass
/// through the C code of PETSc.
template <class Solve>
void solveOrAbort(PC pc, const Solve& solve) {
  try {
    solve(*shellOf(pc)->factor);
  } catch (const Error& error) {
    if (mpi::rank(commOf(pc)) == 0) std::fprintf(stderr, "squeal: error: %s\n", error.what());
    abortRun();
  }
}

PetscErrorCode applyToVector(PC pc, Vec b, Vec x) {
  const PetscScalar* from = nullptr;
  PetscScalar* to = nullptr;
  check(VecGetArrayRead(b, &from));
  check(VecGetArrayWrite(x, &to));
  solveOrAbort(pc, [&](MumpsFactor& factor) { factor.solve(from, to, 1); });
  check(VecRestoreArrayWrite(x, &to));
  check(VecRestoreArrayRead(b, &from));
  return 0;
}

PetscErrorCode applyToBlock(PC pc, Mat b, Mat x) {
  solveOrAbort(pc, [&](MumpsFactor& factor) { solve(factor, b, x); });
  return 0;
}

PetscErrorCode view(PC pc, PetscViewer viewer) {
  const MumpsFactor& factor = *shellOf(pc)->factor;
  check(PetscViewerASCIIPrintf(
      viewer,
      "  MUMPS: order of elimination INFOG(7) %" PetscInt_FMT ", entries INFOG(20) %" PetscInt_FMT
      ", MB estimated INFOG(17) %" PetscInt_FMT ", MB used INFOG(22) %" PetscInt_FMT "\n",
      factor.infog(7), factor.infog(20), factor.infog(17), factor.infog(22)));
  return 0;
}

PetscErrorCode destroy(PC pc) {
  delete shellOf(pc);
  return 0;
}

bool isOurs(PC pc) {
  PetscBool isShell = PETSC_FALSE;
  check(PetscObjectTypeCompare(object(pc), PCSHELL, &isShell));
  return isShell;
}

PC preconditionerOf(KSP solver) {
  PC pc = nullptr;
  check(KSPGetPC(solver, &pc));
  return pc;
}

/// Sets the factorisation of MUMPS as preconditioner.
void setMumps(KSP solver, const SolverPrefix& prefix) {
  const PC pc = preconditionerOf(solver);
  auto shell = std::make_unique<Shell>();
  shell->factor = std::make_unique<MumpsFactor>(commOf(solver), prefix.prefix);
  check(PCSetType(pc, PCSHELL));
  check(PCShellSetContext(pc, shell.release()));
  check(PCShellSetName(pc, "MUMPS, LDLt"));
  check(PCShellSetSetUp(pc, setUp));
  check(PCShellSetApply(pc, applyToVector));
  check(PCShellSetApplyTranspose(pc, applyToVector));
  check(PCShellSetMatApply(pc, applyToBlock));
  check(PCShellSetView(pc, view));
  check(PCShellSetDestroy(pc, destroy));
}

}  // namespace

OwnedKSP directSolver(Mat matrix, const SolverPrefix& prefix) {
  OwnedKSP solver;
  check(KSPCreate(commOf(matrix), solver.out()));
  check(KSPSetOptionsPrefix(solver, prefix.prefix.c_str()));
  check(KSPSetOperators(solver, matrix, matrix));
  check(KSPSetType(solver, KSPPREONLY));
  // An option pc_* selects a preconditioner of PETSc.
  const auto names = prefix.names();
  const bool another = std::ranges::any_of(names, [&](const std::string& name) {
    return name.starts_with("-" + prefix.prefix + "pc_");
  });
  if (another)
    check(PCSetType(preconditionerOf(solver), PCCHOLESKY));
  else
    setMumps(solver, prefix);
  applySolverOptions([&] { return KSPSetFromOptions(solver); });
  return solver;
}

MumpsFactor* mumpsFactor(KSP solver) {
  const PC pc = preconditionerOf(solver);
  return isOurs(pc) ? shellOf(pc)->factor.get() : nullptr;
}

std::string factorise(KSP solver) {
  const PC pc = preconditionerOf(solver);
  applySolverOptions([&] { return KSPSetUp(solver); });
  if (isOurs(pc)) {
    const Shell& shell = *shellOf(pc);
    if (shell.thrown) std::rethrow_exception(shell.thrown);
    return shell.failure;
  }
  PCFailedReason failed;
  check(PCGetFailedReason(pc, &failed));
  return failed == PC_NOERROR ? "" : "see its options pc_*; is a body under-constrained?";
}

KSP SymmetricSolver::get() const {
  if (solver_) {
    factorise();
    return solver_;
  }
  const MPI_Comm comm = commOf(matrix_);
  Stage stage(comm, "factor");
  solver_ = directSolver(matrix_, factorisation);
  factorise();
  PetscInt size = 0;
  check(MatGetSize(matrix_, &size, nullptr));
  stage.finish(formatted("%s: %" PetscInt_FMT " unknowns", name_.c_str(), size));
  return solver_;
}

/// Factorises the matrix on the first call.
void SymmetricSolver::factorise() const {
  check(KSPSetOperators(solver_, matrix_, matrix_));
  if (const std::string why = factor::factorise(solver_); !why.empty())
    throw Error("the " + name_ + " cannot be factorised: " + why);
}

void rejectUnusedSolverOptions() { factorisation.rejectUnused(); }

FactorSize factorSize(Mat matrix) {
  MumpsFactor factor(commOf(matrix), factorisation.prefix);
  factor.analyse(matrix);
  const double entries = factor.infog(20);  // negative: in millions
  return {.bytes = factor.memory(),
          .entries = entries < 0 ? -1e6 * entries : entries,
          .operations = factor.rinfog(1)};
}

std::unique_ptr<MumpsFactor> shiftedFactor(Mat k, Mat m, double sigma, KSP like) {
  auto factor = std::make_unique<MumpsFactor>(commOf(k), factorisation.prefix);
  factor->enableInertia();
  {
    OwnedMat shifted;
    check(MatDuplicate(k, MAT_COPY_VALUES, shifted.out()));
    check(MatAXPY(shifted, -sigma, m, UNKNOWN_NONZERO_PATTERN));
    factor->analyse(shifted, like ? mumpsFactor(like) : nullptr);
  }
  if (const std::string why = factor->factorise(); !why.empty())
    throw Error("the factorisation of a shifted stiffness: " + why);
  return factor;
}

Inertia inertia(Mat matrix, double zero) {
  MumpsFactor factor(commOf(matrix), factorisation.prefix);
  factor.enableInertia(zero);
  factor.analyse(matrix);
  if (const std::string why = factor.factorise(); !why.empty())
    throw Error("the inertia of a symmetric matrix: " + why);
  return factor.inertia();
}

}  // namespace squeal::factor
