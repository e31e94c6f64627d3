#include "flutter/images.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "petsc/symmetric.hpp"

namespace squeal::flutter {

void append(Block& block, const Block& other) {
  block.values.insert(block.values.end(), other.values.begin(), other.values.end());
  block.columns += other.columns;
}

ReadColumns::ReadColumns(BV bv) : bv_(bv) {
  check(BVGetSizes(bv, &rows_, nullptr, &columns_));
  check(BVGetArrayRead(bv, &values_));
}

void multiplyAdd(const double* x, PetscInt rowCount, PetscInt columnCount, const std::vector<double>& coefficients,
                 std::vector<double>& result, double factor) {
  PetscBLASInt rows = rowCount, inner = columnCount,
               columns = static_cast<PetscBLASInt>(coefficients.size() / static_cast<std::size_t>(columnCount));
  const PetscScalar one = 1;
  if (rows > 0 && columns > 0)
    BLASgemm_("N", "N", &rows, &columns, &inner, &factor, x, &rows, coefficients.data(), &inner, &one, result.data(), &rows);
}

DenseMatrix transposedProduct(MPI_Comm comm, const double* x, PetscInt rowCount, PetscInt m, const double* y, PetscInt n) {
  DenseMatrix product(static_cast<std::size_t>(m) * static_cast<std::size_t>(n), 0.0);
  PetscBLASInt rows = rowCount, left = m, right = n;
  const PetscScalar one = 1, zero = 0;
  if (rows > 0 && m > 0 && n > 0) BLASgemm_("T", "N", &left, &right, &rows, &one, x, &rows, y, &rows, &zero, product.data(), &left);
  check(MPI_Allreduce(MPI_IN_PLACE, product.data(), static_cast<int>(product.size()), MPI_DOUBLE, MPI_SUM, comm));
  return product;
}

DenseMatrix transposedProduct(MPI_Comm comm, const Block& x, const Block& y) {
  return transposedProduct(comm, x.values.data(), x.rows, x.columns, y.values.data(), y.columns);
}

/// Orthogonal combinations of columns that hold them but for parts of length `small`.
Block principal(MPI_Comm comm, const Block& columns, double small) {
  if (columns.columns == 0) return columns;
  DenseMatrix combinations = transposedProduct(comm, columns, columns);
  const auto sizes = symmetricEigen(combinations, static_cast<int>(columns.columns));
  const auto n = static_cast<std::size_t>(columns.columns);
  std::size_t first = 0;
  while (first < n && !(sizes[first] > small * small)) ++first;
  combinations.erase(combinations.begin(), combinations.begin() + static_cast<std::ptrdiff_t>(first * n));
  Block kept(columns.rows, static_cast<PetscInt>(n - first));
  multiplyAdd(columns.values.data(), columns.rows, columns.columns, combinations, kept.values);
  return kept;
}

/// The columns that have a length, of unit length.
Block unitColumns(const Block& columns, const std::vector<double>& squares) {
  Block units(columns.rows);
  for (PetscInt j = 0; j < columns.columns; ++j)
    if (const double square = squares[static_cast<std::size_t>(j)]; square > 0)
      units.append(columns.column(j), 1 / std::sqrt(square));
  return units;
}

RowSet::RowSet(Mat matrix) {
  PetscInt first = 0, end = 0;
  check(MatGetOwnershipRange(matrix, &first, &end));
  localRows_ = end - first;
  PetscBool readable = PETSC_FALSE;
  check(MatHasOperation(matrix, MATOP_GET_ROW, &readable));
  if (!readable) rows_.resize(static_cast<std::size_t>(localRows_));
  if (!readable) std::iota(rows_.begin(), rows_.end(), 0);
  for (PetscInt row = first; readable && row < end; ++row) {
    PetscInt entries = 0;
    check(MatGetRow(matrix, row, &entries, nullptr, nullptr));
    if (entries > 0) rows_.push_back(row - first);
    check(MatRestoreRow(matrix, row, &entries, nullptr, nullptr));
  }
}

std::vector<double> RowSet::of(const double* columns, PetscInt count) const {
  std::vector<double> values;
  values.reserve(rows_.size() * static_cast<std::size_t>(count));
  for (PetscInt j = 0; j < count; ++j)
    for (PetscInt row : rows_) values.push_back(columns[j * localRows_ + row]);
  return values;
}

DenseMatrix transposedProduct(MPI_Comm comm, const RowSet& rows, const double* x, PetscInt m, const double* y, PetscInt n) {
  if (rows.all()) return transposedProduct(comm, x, rows.size(), m, y, n);
  return transposedProduct(comm, rows.of(x, m).data(), rows.size(), m, rows.of(y, n).data(), n);
}

void Image::append(const double* values, PetscInt columns) {
  const auto kept = rows_.of(values, columns);
  values_.insert(values_.end(), kept.begin(), kept.end());
}

void Image::combine(const DenseMatrix& combinations, PetscInt columns) {
  std::vector<double> combined(static_cast<std::size_t>(rows_.size()) * combinations.size() / static_cast<std::size_t>(columns),
                               0.0);
  flutter::multiplyAdd(values_.data(), rows_.size(), columns, combinations, combined);
  values_ = std::move(combined);
}

void Image::multiplyAdd(const std::vector<double>& coefficients, PetscInt columns, std::vector<double>& result) const {
  if (rows_.all()) return flutter::multiplyAdd(values_.data(), rows_.size(), columns, coefficients, result);
  const PetscInt count = static_cast<PetscInt>(coefficients.size()) / columns;
  std::vector<double> part(static_cast<std::size_t>(rows_.size() * count), 0.0);
  flutter::multiplyAdd(values_.data(), rows_.size(), columns, coefficients, part);
  for (PetscInt j = 0; j < count; ++j)
    for (PetscInt i = 0; i < rows_.size(); ++i)
      result[static_cast<std::size_t>(j * rows_.localRows() + rows_[i])] += part[static_cast<std::size_t>(j * rows_.size() + i)];
}

DenseMatrix Image::transposedProduct(MPI_Comm comm, const ReadColumns& v, PetscInt xBegin, PetscInt xEnd, PetscInt begin,
                                     PetscInt end) const {
  const double *x = v.values() + xBegin * v.rows(), *image = values_.data() + begin * rows_.size();
  if (rows_.all()) return flutter::transposedProduct(comm, x, rows_.size(), xEnd - xBegin, image, end - begin);
  return flutter::transposedProduct(comm, rows_.of(x, xEnd - xBegin).data(), rows_.size(), xEnd - xBegin, image, end - begin);
}

}  // namespace squeal::flutter
