// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/linalg/gathered.hpp"
#include "base/petsc/object.hpp"
#include "base/system/mpi.hpp"

namespace squeal::linalg {

OwnedMat onRankZero(Mat matrix) {
  PetscInt rows = 0, columns = 0;
  OwnedIS rowSet, columnSet;
  Mat* parts = nullptr;
  check(MatGetSize(matrix, &rows, &columns));
  const int rank = mpi::rank(commOf(matrix));
  check(ISCreateStride(PETSC_COMM_SELF, rank == 0 ? rows : 0, 0, 1, rowSet.out()));
  check(ISCreateStride(PETSC_COMM_SELF, rank == 0 ? columns : 0, 0, 1, columnSet.out()));
  const IS rowsWanted = rowSet, columnsWanted = columnSet;
  check(MatCreateSubMatrices(matrix, 1, &rowsWanted, &columnsWanted, MAT_INITIAL_MATRIX, &parts));
  check(PetscObjectReference(object(parts[0])));
  OwnedMat whole(parts[0]);
  check(MatDestroySubMatrices(1, &parts));
  return whole;
}

DenseMatrix gathered(Mat matrix) {
  if (!matrix) return {};
  const OwnedMat whole = onRankZero(matrix);
  PetscInt n = 0;
  check(MatGetSize(whole, &n, nullptr));
  DenseMatrix result(n, n);
  for (PetscInt row = 0; row < n; ++row) {
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* entries = nullptr;
    check(MatGetRow(whole, row, &count, &columns, &entries));
    for (PetscInt k = 0; k < count; ++k) result(row, columns[k]) = entries[k];
    check(MatRestoreRow(whole, row, &count, &columns, &entries));
  }
  return result;
}

}  // namespace squeal::linalg
