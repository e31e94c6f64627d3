// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A chain of unit springs and unit masses between two walls.
#include <algorithm>

#include "base/petsc/check.hpp"
#include "base/petsc/owned.hpp"
#include "base/system/mpi.hpp"

namespace squeal::test {

constexpr PetscInt chainOrder = 200;

/// Collective. Returns A − shift I, A = tridiag(−1, 2, −1). With `lastIsEmpty`, rank 0 has all
/// rows.
inline OwnedMat chain(double shift = 0, bool lastIsEmpty = false) {
  PetscInt local = PETSC_DECIDE;
  if (lastIsEmpty) local = mpi::rank(PETSC_COMM_WORLD) == 0 ? chainOrder : 0;
  OwnedMat matrix;
  check(MatCreateAIJ(PETSC_COMM_WORLD, local, local, chainOrder, chainOrder, 3, nullptr, 3, nullptr,
                     matrix.out()));
  PetscInt first = 0, last = 0;
  check(MatGetOwnershipRange(matrix, &first, &last));
  for (PetscInt i = first; i < last; ++i)
    for (PetscInt j = std::max<PetscInt>(i - 1, 0); j <= std::min(i + 1, chainOrder - 1); ++j)
      check(MatSetValue(matrix, i, j, i == j ? 2 - shift : -1, INSERT_VALUES));
  check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  check(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
  return matrix;
}

}  // namespace squeal::test
