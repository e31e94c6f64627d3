// SPDX-License-Identifier: BSD-2-Clause
#include "base/petsc/matrix.hpp"

#include "base/petsc/object.hpp"

namespace squeal {

bool isSymmetric(Mat matrix) {
  PetscBool known = PETSC_FALSE, symmetric = PETSC_FALSE;
  check(MatIsSymmetricKnown(matrix, &known, &symmetric));
  return known && symmetric;
}

bool isSparse(Mat matrix) {
  PetscBool sparse = PETSC_FALSE;
  check(PetscObjectTypeCompareAny(object(matrix), &sparse, MATSEQAIJ, MATMPIAIJ, ""));
  return sparse;
}

OwnedIS ownRows(Mat matrix) {
  PetscInt first = 0, end = 0;
  check(MatGetOwnershipRange(matrix, &first, &end));
  OwnedIS rows;
  check(ISCreateStride(commOf(matrix), end - first, first, 1, rows.out()));
  return rows;
}

}  // namespace squeal
