#pragma once
/// Tall matrices that are distributed by rows: the basis V and its images A V. A product of two of
/// them is one BLAS call on the local rows and one reduction.
#include <vector>

#include "linalg/quadratic.hpp"
#include "petsc/owned.hpp"

namespace squeal::linalg {

/// This rank's rows of a tall matrix with n rows over all ranks.
struct Block {
  PetscInt rows = 0, columns = 0;  ///< rows of this rank, columns of the matrix
  std::vector<double> values;      ///< column-major

  explicit Block(PetscInt rowCount, PetscInt columnCount = 0)
      : rows(rowCount),
        columns(columnCount),
        values(static_cast<std::size_t>(rowCount) * static_cast<std::size_t>(columnCount)) {}
  const double* column(PetscInt j) const {
    return values.data() + static_cast<std::ptrdiff_t>(j) * rows;
  }
  double* column(PetscInt j) { return values.data() + static_cast<std::ptrdiff_t>(j) * rows; }
  void reserve(PetscInt columnCount) {
    values.reserve(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columnCount));
  }
  void append(const double* column, double factor = 1) {
    values.resize(values.size() + static_cast<std::size_t>(rows));
    double* to = this->column(columns++);
    for (PetscInt i = 0; i < rows; ++i) to[i] = factor * column[i];
  }
};

/// Appends the columns of another block with the same number of rows. Not collective.
void append(Block& block, const Block& other);

/// Collective. Appends A times the `count` columns, of which this rank's rows are given, to the
/// columns of `result`.
void appendProduct(Mat matrix, const double* columns, PetscInt count, Block& result);

/// Not collective. Computes
///   result += factor · X · coefficients
/// with X rows × columns, coefficients columns × k and result rows × k, all column-major.
void multiplyAdd(const double* x, PetscInt rows, PetscInt columns,
                 const std::vector<double>& coefficients, std::vector<double>& result,
                 double factor = 1);

/// Not collective. Returns X · combinations, where combinations is x.columns × count.
Block combined(const Block& x, const DenseMatrix& combinations, PetscInt count);

/// Not collective. Returns Cᵀ A C for small matrices, where A is size × size.
DenseMatrix congruent(const DenseMatrix& a, PetscInt size, const DenseMatrix& c);

/// Not collective. Returns the rows [first, first + count) of a matrix with `height` rows.
DenseMatrix rowsOf(const DenseMatrix& matrix, std::size_t height, std::size_t first,
                   std::size_t count);

/// Collective. Returns a dense rows × columns matrix that borrows `values`, this rank's localRows
/// rows, column-major.
OwnedMat borrowed(MPI_Comm comm, PetscInt localRows, PetscInt rows, PetscInt columns,
                  const double* values);

/// Collective. Returns Xᵀ Y, m × n, column-major and the same on all ranks. X and Y are given by
/// this rank's rows, X as rows × m and Y as rows × n.
DenseMatrix transposedProduct(MPI_Comm comm, const double* x, PetscInt rows, PetscInt m,
                              const double* y, PetscInt n);
DenseMatrix transposedProduct(MPI_Comm comm, const Block& x, const Block& y);

/// Collective. Returns orthogonal combinations of the columns, the principal directions. Those of
/// length `small` or less are dropped.
Block principal(MPI_Comm comm, const Block& columns, double small);
/// Collective. Returns the columns scaled to the 2-norm 1. Columns of zeros are dropped.
Block unitColumns(MPI_Comm comm, const Block& columns);

/// The rows of a matrix on this rank that have nonzero entries. A friction operator has such rows
/// at the contact nodes only, so that products need not touch the others.
class RowSet {
 public:
  /// Collective. The matrix is borrowed during this call only.
  explicit RowSet(Mat matrix);
  PetscInt size() const { return all_ ? localRows_ : static_cast<PetscInt>(rows_.size()); }
  /// Returns true if the set holds all rows of the matrix, on every rank.
  bool all() const { return all_; }
  PetscInt localRows() const { return localRows_; }
  PetscInt operator[](PetscInt i) const { return all_ ? i : rows_[i]; }
  /// Returns these rows of `count` columns, size() × count. The columns are given by all local
  /// rows, column-major.
  std::vector<double> of(const double* columns, PetscInt count) const;
  /// Returns these rows of the columns [first, last).
  Block of(const Block& columns, PetscInt first, PetscInt last) const;
  /// Collective. Returns these rows of the matrix, with all columns. If the set holds all rows, the
  /// matrix itself is returned, shared.
  OwnedMat of(Mat matrix) const;

 private:
  PetscInt localRows_ = 0, firstRow_ = 0;
  bool all_ = true;
  std::vector<PetscInt> rows_;  // ascending; empty if all
};

/// Collective. Returns Xᵀ Y, m × n, the same on all ranks. X is given by all local rows, and Y by
/// `rows`; its other rows are zero.
DenseMatrix transposedProduct(MPI_Comm comm, const RowSet& rows, const double* x, PetscInt m,
                              const double* y, PetscInt n);
/// Not collective. Computes
///   y += X · coefficients
/// with X given by `rows`, its other rows being zero, coefficients columns × k, and y by all local
/// rows, with k columns.
void multiplyAdd(const RowSet& rows, const Block& x, const std::vector<double>& coefficients,
                 std::vector<double>& y);

}  // namespace squeal::linalg
