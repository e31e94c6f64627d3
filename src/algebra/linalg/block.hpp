// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Operations on tall matrices that are distributed by rows, such as a basis V and a product A V.
/// The product Xᵀ Y of two such matrices takes one BLAS call on the local rows and one reduction.
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "base/petsc/owned.hpp"

namespace squeal::linalg {

/// This rank's rows of a tall matrix, which has n rows on all ranks together.
using Block = DenseMatrix;

/// Collective. Appends A X to the columns of `result`. X and `result` contain this rank's rows.
/// `result` must have its number of rows even if it has no columns, and X must not be part of
/// `result`.
void appendProduct(Mat matrix, const DenseView& x, Block& result);

/// Collective. Returns a dense PETSc matrix with `rows` rows on all ranks together. It borrows the
/// entries of the block, which are this rank's rows, so writing to the matrix changes the block.
OwnedMat borrowed(MPI_Comm comm, PetscInt rows, const DenseView& block);

/// Collective. Returns Xᵀ Y, the same on all ranks. X and Y contain this rank's rows.
DenseMatrix transposedProduct(MPI_Comm comm, const DenseView& x, const DenseView& y);

/// Collective. Does the same without the rows in which Y is zero on this rank. Forces at the
/// contact have few other rows.
DenseMatrix transposedProductWithSparse(MPI_Comm comm, const DenseView& x, const DenseView& y);

/// Collective. Returns the 2-norm of a column, the same on all ranks. `column` contains this rank's
/// rows.
double length(MPI_Comm comm, std::span<const double> column);

/// Collective. Returns A⁻¹ times the columns, where A is the matrix of the solver. Each solve takes
/// a block of columns, large enough for fast dense kernels and small enough for the memory.
Block solved(KSP solver, const DenseView& columns);

/// Not collective. Replaces X by X C, where C has at most as many columns as rows, without a copy
/// of X.
void combineColumns(Block& x, const DenseMatrix& combinations);

/// Collective. Returns the principal directions of the columns, that is, orthogonal combinations of
/// them, in ascending order of length. Directions of length `small` or less are dropped.
Block principal(MPI_Comm comm, const Block& columns, double small);
/// Collective. Returns the columns scaled to the 2-norm 1. Columns of zeros are dropped.
Block unitColumns(MPI_Comm comm, const Block& columns);

/// The rows of a matrix on this rank that have nonzero entries. A friction operator has such rows
/// only at the contact nodes, and products skip all other rows.
class RowSet {
 public:
  /// Collective. Finds the rows. The set contains all rows if PETSc cannot find the nonzero ones in
  /// a matrix of this type, or if their share of all rows exceeds `share`. Borrows the matrix only
  /// during this call.
  explicit RowSet(Mat matrix, double share = 1);
  PetscInt size() const { return all_ ? localRows_ : std::ssize(rows_); }
  /// Returns true if the set contains all rows of the matrix, on every rank.
  bool all() const { return all_; }
  PetscInt localRows() const { return localRows_; }
  PetscInt operator[](PetscInt i) const { return all_ ? i : rows_[i]; }
  /// Returns these rows of X, which contains all local rows.
  Block of(const DenseView& x) const;
  /// Collective. Returns these rows of the matrix, with all columns. If the set contains all rows,
  /// the result shares the matrix itself.
  OwnedMat of(Mat matrix) const;

 private:
  PetscInt localRows_ = 0, firstRow_ = 0;
  bool all_ = true;
  std::vector<PetscInt> rows_;  // local numbers, ascending; empty if all_
};

/// Collective. Returns Xᵀ Y, the same on all ranks. X contains all local rows. Y contains only
/// `rows`; its other rows are zero.
DenseMatrix transposedProduct(MPI_Comm comm, const RowSet& rows, const DenseView& x,
                              const DenseView& y);
/// Not collective. Computes
///   Y += X · C
/// where X contains only `rows` (its other rows are zero), and Y contains all local rows.
void multiplyAdd(const RowSet& rows, const DenseView& x, const DenseView& coefficients, Block& y);

}  // namespace squeal::linalg
