// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Vectors as lists of all their entries, the same on every rank.
#include <vector>

#include "base/petsc/check.hpp"
#include "base/petsc/owned.hpp"
#include "support/dense.hpp"
#include "support/model.hpp"

namespace squeal::test {

/// Pseudo-random entries in [−1, 1] that do not depend on the number of ranks.
inline std::vector<double> randomEntries(PetscInt size, unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<double> entries;
  for (PetscInt i = 0; i < size; ++i) entries.push_back(uniform(generator));
  return entries;
}

/// Collective. A vector that the matrix can be applied to, or with `columns` off its transpose.
inline OwnedVec vectorOf(Mat matrix, bool columns, const std::vector<double>& entries) {
  OwnedVec vector;
  if (columns)
    check(MatCreateVecs(matrix, vector.out(), nullptr));
  else
    check(MatCreateVecs(matrix, nullptr, vector.out()));
  PetscInt first = 0, end = 0;
  check(VecGetOwnershipRange(vector, &first, &end));
  for (PetscInt i = first; i < end; ++i) check(VecSetValue(vector, i, entries[i], INSERT_VALUES));
  check(VecAssemblyBegin(vector));
  check(VecAssemblyEnd(vector));
  return vector;
}

/// Collective. A x or Aᵀ x.
inline std::vector<double> product(Mat matrix, const std::vector<double>& x,
                                   bool transposed = false) {
  const OwnedVec in = vectorOf(matrix, !transposed, x);
  OwnedVec out;
  if (transposed) {
    check(MatCreateVecs(matrix, out.out(), nullptr));
    check(MatMultTranspose(matrix, in, out));
  } else {
    check(MatCreateVecs(matrix, nullptr, out.out()));
    check(MatMult(matrix, in, out));
  }
  return allEntries(out);
}

}  // namespace squeal::test
