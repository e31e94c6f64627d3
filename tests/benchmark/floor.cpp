// SPDX-License-Identifier: BSD-2-Clause
// floor FILE: reads K0, a matrix in the format of PETSc (-report_matrices), and prints the wall
// time in seconds of one factorisation by MUMPS and of 400 solves in blocks of 32 by MatMatSolve.
// The free vibration of 200 modes cannot take less. scripts/bench/floor calls it.
#include <petscmat.h>

#include <algorithm>
#include <cstdio>

#include "base/petsc/owned.hpp"
#include "base/system/blas_kernel.hpp"
#include "base/system/error.hpp"

namespace {

using namespace squeal;

constexpr int solves = 400, block = 32;

/// Collective. Returns the matrix of a file, which is symmetric positive definite.
OwnedMat read(const char* path) {
  OwnedViewer viewer;
  OwnedMat matrix;
  check(PetscViewerBinaryOpen(PETSC_COMM_WORLD, path, FILE_MODE_READ, viewer.out()));
  check(MatCreate(PETSC_COMM_WORLD, matrix.out()));
  check(MatSetType(matrix, MATAIJ));
  check(MatLoad(matrix, viewer));
  check(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
  check(MatSetOption(matrix, MAT_SPD, PETSC_TRUE));
  return matrix;
}

/// Collective. Returns the factors of the matrix.
OwnedMat factorised(Mat matrix) {
  Mat factor = nullptr;
  check(MatGetFactor(matrix, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &factor));
  OwnedMat owner(factor);
  check(MatMumpsSetIcntl(factor, 27, block));  // right-hand sides MUMPS takes at once
  MatFactorInfo info;
  check(MatFactorInfoInitialize(&info));
  check(MatCholeskyFactorSymbolic(factor, matrix, nullptr, &info));
  check(MatCholeskyFactorNumeric(factor, matrix, &info));
  return owner;
}

/// Collective. Solves for random right-hand sides.
void solve(Mat factor, PetscInt localRows) {
  for (int done = 0; done < solves; done += block) {
    OwnedMat rhs, solution;
    check(MatCreateDense(PETSC_COMM_WORLD, localRows, PETSC_DECIDE, PETSC_DETERMINE,
                         std::min(block, solves - done), nullptr, rhs.out()));
    check(MatSetRandom(rhs, nullptr));
    check(MatDuplicate(rhs, MAT_DO_NOT_COPY_VALUES, solution.out()));
    check(MatMatSolve(factor, rhs, solution));
  }
}

/// Collective. Returns the wall time on the slowest rank, s.
double floorSeconds(Mat matrix) {
  PetscInt localRows = 0;
  check(MatGetLocalSize(matrix, &localRows, nullptr));
  const double begin = MPI_Wtime();
  const OwnedMat factor = factorised(matrix);
  solve(factor, localRows);
  return mpi::max(PETSC_COMM_WORLD, MPI_Wtime() - begin);
}

}  // namespace

int main(int argc, char** argv) {
  restartWithBlasKernel(argv);
  check(PetscInitialize(&argc, &argv, nullptr, nullptr));
  if (argc != 2) {
    std::fputs("usage: floor FILE\n", stderr);
    return 1;
  }
  const double seconds = floorSeconds(read(argv[1]));
  check(PetscPrintf(PETSC_COMM_WORLD, "%.3f\n", seconds));
  check(PetscFinalize());
}
