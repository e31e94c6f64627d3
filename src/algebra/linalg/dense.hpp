// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Small dense matrices, and the local rows of tall ones, stored by columns.
#include <petscsys.h>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "algebra/linalg/complex.hpp"
#include "base/petsc/check.hpp"

namespace squeal::linalg {

/// A read-only view of a dense matrix, rows × columns, stored column by column without gaps. The
/// entries are borrowed.
class DenseView {
 public:
  DenseView(const double* entries, PetscInt rows, PetscInt columns)
      : entries_(entries), rows_(rows), columns_(columns) {}

  PetscInt rows() const { return rows_; }
  PetscInt columns() const { return columns_; }
  bool empty() const { return rows_ == 0 || columns_ == 0; }
  double operator()(PetscInt i, PetscInt j) const { return column(j)[i]; }
  const double* data() const { return entries_; }
  std::size_t size() const { return entries().size(); }  ///< number of entries
  std::span<const double> entries() const { return {entries_, entries_ + offset(columns_)}; }
  std::span<const double> column(PetscInt j) const {
    return {entries_ + offset(j), entries_ + offset(j + 1)};
  }
  /// Returns the columns [first, last).
  DenseView columnRange(PetscInt first, PetscInt last) const {
    return {entries_ + offset(first), rows_, last - first};
  }

 private:
  /// A matrix may have more entries than a PetscInt can count.
  std::ptrdiff_t offset(std::ptrdiff_t column) const { return column * rows_; }
  const double* entries_;
  PetscInt rows_, columns_;
};

/// A matrix of doubles or complex numbers, rows × columns, stored column by column. It appends
/// columns in place if enough space is reserved.
template <class Scalar>
class Dense {
 public:
  Dense() = default;
  /// Makes a matrix of zeros.
  explicit Dense(PetscInt rows, PetscInt columns = 0)
      : rows_(rows), columns_(columns), entries_(offset(columns)) {}
  /// Takes the entries, column by column.
  Dense(PetscInt rows, PetscInt columns, std::vector<Scalar> entries)
      : rows_(rows), columns_(columns), entries_(std::move(entries)) {
    ensure(std::ssize(entries_) == offset(columns_), "a matrix has rows × columns entries");
  }
  explicit Dense(const DenseView& other)
      : rows_(other.rows()),
        columns_(other.columns()),
        entries_(other.entries().begin(), other.entries().end()) {}
  operator DenseView() const { return {entries_.data(), rows_, columns_}; }

  PetscInt rows() const { return rows_; }
  PetscInt columns() const { return columns_; }
  bool empty() const { return entries_.empty(); }
  Scalar& operator()(PetscInt i, PetscInt j) { return entries_[offset(j) + i]; }
  const Scalar& operator()(PetscInt i, PetscInt j) const { return entries_[offset(j) + i]; }
  Scalar* data() { return entries_.data(); }
  const Scalar* data() const { return entries_.data(); }
  std::size_t size() const { return entries_.size(); }  ///< number of entries
  std::span<Scalar> entries() { return entries_; }
  std::span<const Scalar> entries() const { return entries_; }
  std::span<Scalar> column(PetscInt j) {
    return {entries_.data() + offset(j), entries_.data() + offset(j + 1)};
  }
  std::span<const Scalar> column(PetscInt j) const {
    return {entries_.data() + offset(j), entries_.data() + offset(j + 1)};
  }
  /// Returns the columns [first, last), borrowed.
  DenseView columnRange(PetscInt first, PetscInt last) const {
    return DenseView(*this).columnRange(first, last);
  }

  /// Reserves space for this total number of columns.
  void reserve(PetscInt columnCount) { entries_.reserve(offset(columnCount)); }
  /// Appends columns of zeros, or drops the last columns.
  void resizeColumns(PetscInt columnCount) {
    columns_ = columnCount;
    entries_.resize(offset(columnCount));
  }
  /// Appends the columns of `more`, which must have the same number of rows and must not be part of
  /// this matrix. A matrix without columns adopts the number of rows of `more`.
  void append(const DenseView& more) {
    if (more.columns() == 0) return;
    if (columns_ == 0) rows_ = more.rows();
    ensure(more.rows() == rows_, "appended columns have the rows of the matrix");
    entries_.insert(entries_.end(), more.entries().begin(), more.entries().end());
    columns_ += more.columns();
  }
  void append(std::span<const Scalar> column) {
    ensure(std::ssize(column) == rows_, "an appended column has the rows of the matrix");
    entries_.insert(entries_.end(), column.begin(), column.end());
    ++columns_;
  }

 private:
  /// A matrix may have more entries than a PetscInt can count.
  std::ptrdiff_t offset(std::ptrdiff_t column) const { return column * rows_; }
  PetscInt rows_ = 0, columns_ = 0;
  std::vector<Scalar> entries_;
};

using DenseMatrix = Dense<double>;
using ComplexMatrix = Dense<Complex>;

/// The following functions are not collective.

/// Computes
///   result += factor · X · C
/// where X is rows × k, C is k × columns and the result is rows × columns.
void multiplyAdd(const DenseView& x, const DenseView& coefficients, DenseMatrix& result,
                 double factor = 1);
/// Returns X · C.
DenseMatrix product(const DenseView& x, const DenseView& coefficients);
/// Returns Xᵀ Y.
DenseMatrix transposedProduct(const DenseView& x, const DenseView& y);
/// Returns the identity matrix.
DenseMatrix identity(PetscInt size);
/// Returns the square of the 2-norm of a column.
double squaredLength(std::span<const double> x);
/// Returns true if all entries are zero.
bool isZero(const DenseView& a);
/// Returns Cᵀ A C.
DenseMatrix congruent(const DenseView& a, const DenseView& c);
/// Returns Xᵀ.
DenseMatrix transposed(const DenseView& x);
/// Returns the rows [first, last).
DenseMatrix rowRange(const DenseView& matrix, PetscInt first, PetscInt last);
/// Returns the square matrix A with new columns and rows. `right` contains the new columns, with
/// all rows of the result, and `below` the new rows, only in the columns of A. If `below` is empty,
/// the new rows mirror the new columns.
DenseMatrix bordered(const DenseView& a, const DenseView& right, const DenseView& below);
/// Computes
///   sum += factor · A
/// for matrices of the same size. An empty `sum` and an empty A are treated as zero.
void addScaled(DenseMatrix& sum, double factor, const DenseView& a);
/// Does the same as addScaled() for a matrix A that belongs to an earlier, smaller basis: A is
/// extended by rows and columns of zeros. Both bases must begin with the same vectors.
void addExtended(DenseMatrix& sum, double factor, const DenseView& a);

}  // namespace squeal::linalg
