// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Distributed matrices and vectors from lists of their entries and back, the same on every rank;
/// their products and solutions.
#include <petscksp.h>

#include <random>
#include <tuple>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "base/petsc/check.hpp"
#include "base/petsc/owned.hpp"
#include "support/algebra/dense.hpp"

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

/// Collective. All entries on every rank.
inline linalg::DenseMatrix denseCopy(Mat matrix) {
  PetscInt rowCount = 0, columnCount = 0;
  check(MatGetSize(matrix, &rowCount, &columnCount));
  OwnedIS rows, columns;
  check(ISCreateStride(PETSC_COMM_SELF, rowCount, 0, 1, rows.out()));
  check(ISCreateStride(PETSC_COMM_SELF, columnCount, 0, 1, columns.out()));
  const IS rowSets[] = {rows}, columnSets[] = {columns};
  Mat* sub = nullptr;
  check(MatCreateSubMatrices(matrix, 1, rowSets, columnSets, MAT_INITIAL_MATRIX, &sub));
  OwnedMat dense;
  check(MatConvert(sub[0], MATSEQDENSE, MAT_INITIAL_MATRIX, dense.out()));
  check(MatDestroySubMatrices(1, &sub));
  const PetscScalar* values = nullptr;
  check(MatDenseGetArrayRead(dense, &values));
  linalg::DenseMatrix copy(linalg::DenseView(values, rowCount, columnCount));
  check(MatDenseRestoreArrayRead(dense, &values));
  return copy;
}

/// Collective. All entries on every rank.
inline std::vector<double> allEntries(Vec vector) {
  OwnedScatter scatter;
  OwnedVec all;
  check(VecScatterCreateToAll(vector, scatter.out(), all.out()));
  check(VecScatterBegin(scatter, vector, all, INSERT_VALUES, SCATTER_FORWARD));
  check(VecScatterEnd(scatter, vector, all, INSERT_VALUES, SCATTER_FORWARD));
  PetscInt size = 0;
  const PetscScalar* values = nullptr;
  check(VecGetSize(all, &size));
  check(VecGetArrayRead(all, &values));
  std::vector<double> copy(values, values + size);
  check(VecRestoreArrayRead(all, &values));
  return copy;
}

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

/// Collective. xᵀ A y.
inline double form(Vec x, Mat a, Vec y) {
  OwnedVec product;
  check(VecDuplicate(x, product.out()));
  check(MatMult(a, y, product));
  PetscScalar value = 0;
  check(VecDot(x, product, &value));
  return value;
}

inline double dot(Vec x, Vec y) {
  PetscScalar value = 0;
  check(VecDot(x, y, &value));
  return value;
}

/// Collective. u = A⁻¹ b by MUMPS.
inline void solveDirectly(Mat matrix, Vec rhs, Vec u) {
  OwnedKSP solver;
  PC pc = nullptr;
  check(KSPCreate(commOf(matrix), solver.out()));
  check(KSPSetOperators(solver, matrix, matrix));
  check(KSPSetType(solver, KSPPREONLY));
  check(KSPGetPC(solver, &pc));
  check(PCSetType(pc, PCLU));
  check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  check(KSPSolve(solver, rhs, u));
}

}  // namespace squeal::test
