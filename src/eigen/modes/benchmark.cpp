#include "eigen/modes/benchmark.hpp"

#include "base/options/options.hpp"
#include "base/session/stages.hpp"
#include "base/system/text.hpp"

namespace squeal::modes {
namespace {

const FlagOption benchmarkOption("modes", "modes_benchmark", false,
                                 "time one factorisation and 400 solves in blocks of 32, the floor "
                                 "of the stage");

}  // namespace

bool benchmarkWanted() { return benchmarkOption.get(); }

double floorSeconds(Mat stiffness) {
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(stiffness));
  Stage stage(comm, "floor");
  const double begin = MPI_Wtime();
  Mat factor = nullptr;
  check(MatGetFactor(stiffness, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &factor));
  const OwnedMat owner(factor);
  check(MatMumpsSetIcntl(factor, 27, 32));  // right-hand sides MUMPS takes at once
  MatFactorInfo info;
  check(MatFactorInfoInitialize(&info));
  check(MatCholeskyFactorSymbolic(factor, stiffness, nullptr, &info));
  check(MatCholeskyFactorNumeric(factor, stiffness, &info));
  const double factored = MPI_Wtime();
  PetscInt local = 0;
  check(MatGetLocalSize(stiffness, &local, nullptr));
  for (int done = 0; done < 400; done += 32) {
    const PetscInt columns = std::min(32, 400 - done);
    OwnedMat rhs, solution;
    check(MatCreateDense(comm, local, PETSC_DECIDE, PETSC_DETERMINE, columns, nullptr, rhs.out()));
    check(MatSetRandom(rhs, nullptr));
    check(MatDuplicate(rhs, MAT_DO_NOT_COPY_VALUES, solution.out()));
    check(MatMatSolve(factor, rhs, solution));
  }
  double seconds = MPI_Wtime() - begin;
  check(MPI_Allreduce(MPI_IN_PLACE, &seconds, 1, MPI_DOUBLE, MPI_MAX, comm));
  stage.finish(
      formatted("one factorisation %.2f s and 400 solves in blocks of 32", factored - begin));
  return seconds;
}

}  // namespace squeal::modes
