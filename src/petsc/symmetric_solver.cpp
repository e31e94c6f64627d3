#include "petsc/symmetric_solver.hpp"

#include <string>

#include "petsc/stages.hpp"
#include "petsc/text.hpp"

namespace squeal {
namespace {

const SolverPrefix factorisation("modes", "modes_st_",
                                 "SLEPc ST, KSP and PC with the factorisation of K (MUMPS LDLt): st_type, ksp_*, pc_*, …");

}  // namespace

OwnedKSP directSolver(Mat matrix, const SolverPrefix& prefix) {
  OwnedKSP solver;
  check(KSPCreate(PetscObjectComm(reinterpret_cast<PetscObject>(matrix)), solver.out()));
  check(KSPSetOptionsPrefix(solver, prefix.prefix.c_str()));
  check(KSPSetOperators(solver, matrix, matrix));
  check(KSPSetType(solver, KSPPREONLY));
  PC pc = nullptr;
  check(KSPGetPC(solver, &pc));
  check(PCSetType(pc, PCCHOLESKY));
  check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  check(KSPSetFromOptions(solver));
  // Right-hand sides that MUMPS takes at once: by itself 32, and the few that are left over cost a pass of their own. An option
  // -…_mat_mumps_icntl_27 has the last word.
  if (const Mat factor = mumpsFactor(solver)) check(MatMumpsSetIcntl(factor, 27, 64));
  return solver;
}

Mat mumpsFactor(KSP solver) {
  PC pc = nullptr;
  PetscBool cholesky = PETSC_FALSE;
  MatSolverType package = nullptr;
  Mat factor = nullptr;
  check(KSPGetPC(solver, &pc));
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(pc), PCCHOLESKY, &cholesky));
  if (!cholesky) return nullptr;
  check(PCFactorGetMatSolverType(pc, &package));
  if (std::string(package) != MATSOLVERMUMPS) return nullptr;
  check(PCFactorSetUpMatSolverType(pc));
  check(PCFactorGetMatrix(pc, &factor));
  return factor;
}

KSP SymmetricSolver::get() const {
  if (solver_) {
    factorise();
    return solver_;
  }
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(matrix_));
  Stage stage(comm, "factor");
  solver_ = directSolver(matrix_, factorisation);
  factorise();
  PetscInt size = 0;
  check(MatGetSize(matrix_, &size, nullptr));
  stage.finish(formatted("%s: %d unknowns", name_.c_str(), static_cast<int>(size)));
  return solver_;
}

/// Does nothing where the factorisation is at hand.
void SymmetricSolver::factorise() const {
  PC pc = nullptr;
  check(KSPSetOperators(solver_, matrix_, matrix_));
  check(KSPSetUp(solver_));
  check(KSPGetPC(solver_, &pc));
  PCFailedReason failed;
  check(PCGetFailedReason(pc, &failed));
  if (failed != PC_NOERROR)
    throw Error("the " + name_ + " cannot be factorised (options -modes_st_pc_*): is a body loose, or is memory short?");
}

void rejectUnusedSolverOptions() { factorisation.rejectUnused(); }

double factorMemory(Mat matrix) {
  Mat factor = nullptr;
  check(MatGetFactor(matrix, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &factor));
  const OwnedMat owner(factor);
  MatFactorInfo info;
  check(MatFactorInfoInitialize(&info));
  check(MatCholeskyFactorSymbolic(factor, matrix, nullptr, &info));
  PetscInt megabytes = 0;
  check(MatMumpsGetInfog(factor, 17, &megabytes));
  return 1e6 * static_cast<double>(megabytes);
}

Inertia inertia(Mat matrix, double zero) {
  Mat factor = nullptr;
  check(MatGetFactor(matrix, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &factor));
  const OwnedMat owner(factor);
  check(MatMumpsSetIcntl(factor, 13, 1));  // ScaLAPACK on the root would hide its pivots' signs
  check(MatMumpsSetIcntl(factor, 24, 1));
  if (zero > 0) check(MatMumpsSetCntl(factor, 3, zero));
  MatFactorInfo info;
  check(MatFactorInfoInitialize(&info));
  check(MatCholeskyFactorSymbolic(factor, matrix, nullptr, &info));
  check(MatCholeskyFactorNumeric(factor, matrix, &info));
  MatFactorError failed = MAT_FACTOR_NOERROR;
  check(MatFactorGetError(factor, &failed));
  if (failed != MAT_FACTOR_NOERROR) throw Error("the inertia of a symmetric matrix: MUMPS fails; is memory short?");
  Inertia found;
  check(MatGetInertia(factor, &found.negative, &found.zero, nullptr));
  return found;
}

}  // namespace squeal
