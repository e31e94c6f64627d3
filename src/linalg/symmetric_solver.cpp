#include "linalg/symmetric_solver.hpp"

#include <algorithm>
#include <iterator>
#include <string>

#include "petsc/memory.hpp"
#include "petsc/text.hpp"
#include "session/stages.hpp"

namespace squeal::linalg {
namespace {

const SolverPrefix factorisation(
    "modes", "modes_st_",
    "SLEPc ST, KSP and PC with the factorisation of K (MUMPS LDLt): st_type, ksp_*, pc_*, …");

/// Returns the reason why MUMPS failed, from INFOG(1) and INFOG(2) of its manual; empty if it did
/// not fail.
std::string failureOf(Mat factor) {
  PetscInt code = 0, detail = 0;
  check(MatMumpsGetInfog(factor, 1, &code));
  check(MatMumpsGetInfog(factor, 2, &detail));
  if (code >= 0) return "";
  const std::string numbers =
      formatted(" (INFOG(1) = %" PetscInt_FMT ", INFOG(2) = %" PetscInt_FMT ")", code, detail);
  constexpr PetscInt allocations[] = {-5, -7, -13, -19, -22},
                     workspace[] = {-8, -9, -11, -14, -15, -17, -20}, overflow[] = {-51, -52};
  const auto among = [&](const auto& codes) {
    return std::find(std::begin(codes), std::end(codes), code) != std::end(codes);
  };
  if (among(allocations)) return "MUMPS got no more memory" + numbers + ": " + lessMemory;
  if (among(workspace))
    return "MUMPS needs a larger workspace than it foresaw" + numbers +
           ": raise -…_mat_mumps_icntl_14, percent, for example to 50";
  if (among(overflow))
    return "the factor has more entries than 32-bit integers count" + numbers + ": take more ranks";
  if (code == -6 || code == -10) return "the matrix is singular" + numbers + ": is a body loose?";
  return "MUMPS fails" + numbers;
}

using Symbolic = PetscErrorCode (*)(Mat, Mat, IS, const MatFactorInfo*);
Symbolic analysisOfMumps = nullptr;

/// The ratio of the memory foreseen to the free memory above which the factorisation is not tried.
constexpr double hopeless = 2;
/// The reason why the last analysis ended the factorisation, the same on all ranks; empty if it did
/// not.
std::string shortage;

/// Collective. Compares the memory that the analysis of MUMPS foresees with the free memory, before
/// the machine begins to swap or the kernel ends the process. Warns, or sets `shortage`.
void compareWithMemory(Mat factor) {
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(factor));
  PetscInt megabytes = 0;
  check(MatMumpsGetInfo(factor, 15, &megabytes));
  double needed = 1e6 * megabytes;
  const double free = memoryFreeOnNode(comm, needed);
  struct {
    double ratio;
    int rank;
  } worst{needed / std::max(free, 1.0), 0};
  check(MPI_Comm_rank(comm, &worst.rank));
  check(MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE_INT, MPI_MAXLOC, comm));
  if (worst.ratio <= 1) return;
  double sizes[] = {needed, free};
  check(MPI_Bcast(sizes, 2, MPI_DOUBLE, worst.rank, comm));
  const std::string text =
      formatted("the factorisation needs %.3g GB on a node where %.3g GB are free", 1e-9 * sizes[0],
                1e-9 * sizes[1]);
  if (worst.ratio > hopeless)
    shortage = text + ": " + lessMemory;
  else
    complain(comm, "warning: " + text);
}

PetscErrorCode analyse(Mat factor, Mat matrix, IS order, const MatFactorInfo* info) {
  PetscFunctionBegin;
  PetscCall(analysisOfMumps(factor, matrix, order, info));
  compareWithMemory(factor);
  PetscFunctionReturn(shortage.empty() ? 0 : PETSC_ERR_MEM);
}

/// MUMPS foresees its workspace from the pattern alone, and pivoting may need more: then the
/// factorisation is made anew with these percentages more (ICNTL(14)).
constexpr PetscInt workspaces[] = {100, 400};

bool lacksWorkspace(Mat factor) {
  PetscInt code = 0;
  check(MatMumpsGetInfog(factor, 1, &code));
  return code == -8 || code == -9;
}

void enlargeWorkspace(Mat factor, PetscInt percent) {
  PetscInt given = 0;
  check(MatMumpsGetIcntl(factor, 14, &given));
  check(MatMumpsSetIcntl(factor, 14, std::max(given, percent)));
}

/// Makes the analysis of this factor by MUMPS be followed by analyse().
void watch(Mat factor) {
  void (*operation)() = nullptr;
  check(MatGetOperation(factor, MATOP_CHOLESKY_FACTOR_SYMBOLIC, &operation));
  analysisOfMumps = reinterpret_cast<Symbolic>(operation);
  check(MatSetOperation(factor, MATOP_CHOLESKY_FACTOR_SYMBOLIC,
                        reinterpret_cast<void (*)()>(analyse)));
}

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
  applySolverOptions([&] { return KSPSetFromOptions(solver); });
  // MUMPS solves for this number of right-hand sides in one pass. Its default is 32, and the
  // remaining few then cost a pass of their own. An option -…_mat_mumps_icntl_27 takes precedence.
  if (const Mat factor = mumpsFactor(solver)) {
    check(MatMumpsSetIcntl(factor, 27, 64));
    watch(factor);
  }
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

namespace {

void setUp(KSP solver) {
  shortage.clear();
  applySolverOptions([&] {
    const PetscErrorCode code = KSPSetUp(solver);
    if (!shortage.empty()) throw Error(shortage);
    return code;
  });
}

}  // namespace

void factorise(OwnedKSP& solver, const SolverPrefix& prefix) {
  setUp(solver);
  for (const PetscInt percent : workspaces) {
    const Mat factor = mumpsFactor(solver);
    if (!factor || !lacksWorkspace(factor)) return;
    PetscInt withInertia = 0;
    Mat matrix = nullptr;
    check(MatMumpsGetIcntl(factor, 13, &withInertia));
    check(KSPGetOperators(solver, &matrix, nullptr));
    check(PetscObjectReference(reinterpret_cast<PetscObject>(matrix)));
    const OwnedMat kept(matrix);
    solver = directSolver(matrix, prefix);  // PETSc does not use a factor again that has failed
    check(MatMumpsSetIcntl(mumpsFactor(solver), 13, withInertia));
    enlargeWorkspace(mumpsFactor(solver), percent);
    setUp(solver);
  }
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
  stage.finish(formatted("%s: %" PetscInt_FMT " unknowns", name_.c_str(), size));
  return solver_;
}

/// Factorises the matrix, unless that has been done.
void SymmetricSolver::factorise() const {
  PC pc = nullptr;
  check(KSPSetOperators(solver_, matrix_, matrix_));
  linalg::factorise(solver_, factorisation);
  check(KSPGetPC(solver_, &pc));
  PCFailedReason failed;
  check(PCGetFailedReason(pc, &failed));
  if (failed != PC_NOERROR) {
    const Mat factor = mumpsFactor(solver_);
    const std::string why =
        factor ? failureOf(factor) : "see the options -modes_st_pc_*; is a body loose?";
    throw Error("the " + name_ + " cannot be factorised: " + why);
  }
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
  return 1e6 * megabytes;
}

namespace {

/// Returns a factor that is made with this percentage of workspace more.
OwnedMat factorOf(Mat matrix, double zero, PetscInt percent) {
  OwnedMat factor;
  check(MatGetFactor(matrix, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, factor.out()));
  check(MatMumpsSetIcntl(factor, 13, 1));  // ScaLAPACK on the root would hide its pivots' signs
  check(MatMumpsSetIcntl(factor, 24, 1));
  if (zero > 0) check(MatMumpsSetCntl(factor, 3, zero));
  if (percent > 0) enlargeWorkspace(factor, percent);
  MatFactorInfo info;
  check(MatFactorInfoInitialize(&info));
  check(MatCholeskyFactorSymbolic(factor, matrix, nullptr, &info));
  shortage.clear();
  compareWithMemory(factor);
  if (!shortage.empty()) throw Error(shortage);
  check(MatCholeskyFactorNumeric(factor, matrix, &info));
  return factor;
}

}  // namespace

Inertia inertia(Mat matrix, double zero) {
  OwnedMat factor = factorOf(matrix, zero, 0);
  for (const PetscInt percent : workspaces)
    if (lacksWorkspace(factor)) factor = factorOf(matrix, zero, percent);
  MatFactorError failed = MAT_FACTOR_NOERROR;
  check(MatFactorGetError(factor, &failed));
  if (failed != MAT_FACTOR_NOERROR)
    throw Error("the inertia of a symmetric matrix: " + failureOf(factor));
  Inertia found;
  check(MatGetInertia(factor, &found.negative, &found.zero, nullptr));
  return found;
}

}  // namespace squeal::linalg
