#pragma once
/// Tall matrices by this rank's rows: the basis V and its images A V. Products of them are BLAS on
/// the local rows and one reduction.
#include <vector>

#include "linalg/dense.hpp"
#include "petsc/owned.hpp"

namespace squeal::linalg {

/// Columns of length n, this rank's rows of them.
struct Block {
  PetscInt rows = 0, columns = 0;
  std::vector<double> values;  ///< column-major

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

/// Adds the columns of another block.
void append(Block& block, const Block& other);

/// Collective. Adds A times columns of length n, given by this rank's rows, to the columns of
/// `result`.
void appendProduct(Mat matrix, const double* columns, PetscInt count, Block& result);

/// result (rows × k) += factor · X (rows × columns) · coefficients (columns × k), local, all
/// column-major.
void multiplyAdd(const double* x, PetscInt rows, PetscInt columns,
                 const std::vector<double>& coefficients, std::vector<double>& result,
                 double factor = 1);

/// X · combinations (x.columns × count), local.
Block combined(const Block& x, const DenseMatrix& combinations, PetscInt count);

/// Cᵀ A C of small matrices, A size × size. Not collective.
DenseMatrix congruent(const DenseMatrix& a, PetscInt size, const DenseMatrix& c);

/// Rows [first, first + count) of a matrix of this height.
DenseMatrix rowsOf(const DenseMatrix& matrix, std::size_t height, std::size_t first,
                   std::size_t count);

/// Columns by this rank's rows as a dense matrix that borrows them.
OwnedMat borrowed(MPI_Comm comm, PetscInt localRows, PetscInt rows, PetscInt columns,
                  const double* values);

/// Collective. Xᵀ Y for X rows × m and Y rows × n, column-major m × n, the same on all ranks.
DenseMatrix transposedProduct(MPI_Comm comm, const double* x, PetscInt rows, PetscInt m,
                              const double* y, PetscInt n);
DenseMatrix transposedProduct(MPI_Comm comm, const Block& x, const Block& y);

/// Collective. Orthogonal combinations of columns that hold them but for parts of length `small`.
Block principal(MPI_Comm comm, const Block& columns, double small);
/// Collective. The columns that have a length, of unit length.
Block unitColumns(MPI_Comm comm, const Block& columns);

/// The rows of a matrix on this rank that hold anything but zeros: a friction operator has some at
/// the contact nodes alone.
class RowSet {
 public:
  /// Collective.
  explicit RowSet(Mat matrix);
  PetscInt size() const { return all_ ? localRows_ : static_cast<PetscInt>(rows_.size()); }
  /// Of every rank.
  bool all() const { return all_; }
  PetscInt localRows() const { return localRows_; }
  PetscInt operator[](PetscInt i) const { return all_ ? i : rows_[static_cast<std::size_t>(i)]; }
  /// These rows of columns given by all local rows, column-major.
  std::vector<double> of(const double* columns, PetscInt count) const;
  Block of(const Block& columns, PetscInt first, PetscInt last) const;
  /// Collective. These rows of the matrix, all columns; the matrix itself where there are no
  /// others.
  OwnedMat of(Mat matrix) const;

 private:
  PetscInt localRows_ = 0, firstRow_ = 0;
  bool all_ = true;
  std::vector<PetscInt> rows_;  // ascending; empty if all
};

/// Collective. Xᵀ Y for columns X given by all local rows, and columns Y by `rows`, zero elsewhere.
DenseMatrix transposedProduct(MPI_Comm comm, const RowSet& rows, const double* x, PetscInt m,
                              const double* y, PetscInt n);
/// y (all local rows × k) += X · coefficients (columns × k) for columns X given by `rows`, zero
/// elsewhere.
void multiplyAdd(const RowSet& rows, const Block& x, const std::vector<double>& coefficients,
                 std::vector<double>& y);

}  // namespace squeal::linalg
