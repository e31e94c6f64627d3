// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Sparse matrices from lists of their entries.
#include <tuple>
#include <vector>

#include "base/petsc/check.hpp"
#include "base/petsc/owned.hpp"

namespace squeal::test {

/// Rows, columns and values.
using EntryList = std::vector<std::tuple<PetscInt, PetscInt, double>>;

/// Collective. Returns the square matrix with these entries, at most four in a row.
inline OwnedMat matrixOf(PetscInt size, const EntryList& entries) {
  OwnedMat result;
  check(MatCreateAIJ(PETSC_COMM_WORLD, PETSC_DECIDE, PETSC_DECIDE, size, size, 4, nullptr, 4,
                     nullptr, result.out()));
  PetscInt first = 0, end = 0;
  check(MatGetOwnershipRange(result, &first, &end));
  for (const auto& [row, column, value] : entries)
    if (row >= first && row < end) check(MatSetValue(result, row, column, value, INSERT_VALUES));
  check(MatAssemblyBegin(result, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(result, MAT_FINAL_ASSEMBLY));
  return result;
}

}  // namespace squeal::test
