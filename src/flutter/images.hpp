#pragma once
/// Tall matrices by this rank's rows: the basis V and its images A V. Products of them are BLAS on the local rows and one
/// reduction.
#include <vector>

#include "flutter/dense.hpp"
#include "petsc/owned.hpp"

namespace squeal::flutter {

/// Columns of length n, this rank's rows of them.
struct Block {
  PetscInt rows = 0, columns = 0;
  std::vector<double> values;  ///< column-major

  explicit Block(PetscInt rowCount, PetscInt columnCount = 0)
      : rows(rowCount), columns(columnCount), values(static_cast<std::size_t>(rowCount * columnCount)) {}
  const double* column(PetscInt j) const { return values.data() + j * rows; }
  double* column(PetscInt j) { return values.data() + j * rows; }
  void append(const double* column, double factor = 1) {
    for (PetscInt i = 0; i < rows; ++i) values.push_back(factor * column[i]);
    ++columns;
  }
};

/// The local rows of a BV of type svec for the life of the object: column-major, contiguous.
class ReadColumns {
 public:
  explicit ReadColumns(BV bv);
  ~ReadColumns() { BVRestoreArrayRead(bv_, &values_); }
  ReadColumns(const ReadColumns&) = delete;
  ReadColumns& operator=(const ReadColumns&) = delete;
  const PetscScalar* values() const { return values_; }
  PetscInt rows() const { return rows_; }
  PetscInt columns() const { return columns_; }

 private:
  BV bv_;
  PetscInt rows_ = 0, columns_ = 0;
  const PetscScalar* values_ = nullptr;
};

/// result (rows × k) += factor · X (rows × columns) · coefficients (columns × k), local, all column-major.
void multiplyAdd(const double* x, PetscInt rows, PetscInt columns, const std::vector<double>& coefficients,
                 std::vector<double>& result, double factor = 1);

/// Collective. Xᵀ Y for X rows × m and Y rows × n, column-major m × n, the same on all ranks.
DenseMatrix transposedProduct(MPI_Comm comm, const double* x, PetscInt rows, PetscInt m, const double* y, PetscInt n);
DenseMatrix transposedProduct(MPI_Comm comm, const Block& x, const Block& y);

/// A V by this rank's rows, without the rows of A that are empty: a friction operator has rows at the contact nodes alone.
class Image {
 public:
  explicit Image(Mat matrix);
  /// Adds columns given by all local rows.
  void append(const double* values, PetscInt columns);
  /// A V ← A V · combinations (columns × k).
  void combine(const DenseMatrix& combinations, PetscInt columns);
  /// result (all local rows × k) += (A V) · coefficients.
  void multiplyAdd(const std::vector<double>& coefficients, PetscInt columns, std::vector<double>& result) const;
  /// Collective. Columns [xBegin, xEnd) of V, transposed, times columns [begin, end) of A V.
  DenseMatrix transposedProduct(MPI_Comm comm, const ReadColumns& v, PetscInt xBegin, PetscInt xEnd, PetscInt begin,
                                PetscInt end) const;

 private:
  PetscInt localRows_ = 0;
  std::vector<PetscInt> rows_;  // local rows kept, ascending
  std::vector<double> values_;  // column-major, rows_.size() high
};

}  // namespace squeal::flutter
