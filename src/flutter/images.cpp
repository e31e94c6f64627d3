#include "flutter/images.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <algorithm>
#include <numeric>

namespace squeal::flutter {

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

Image::Image(Mat matrix) {
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

void Image::append(const double* values, PetscInt columns) {
  values_.reserve(values_.size() + rows_.size() * static_cast<std::size_t>(columns));
  for (PetscInt j = 0; j < columns; ++j)
    for (PetscInt row : rows_) values_.push_back(values[j * localRows_ + row]);
}

void Image::combine(const DenseMatrix& combinations, PetscInt columns) {
  std::vector<double> combined(rows_.size() * combinations.size() / static_cast<std::size_t>(columns), 0.0);
  flutter::multiplyAdd(values_.data(), static_cast<PetscInt>(rows_.size()), columns, combinations, combined);
  values_ = std::move(combined);
}

void Image::multiplyAdd(const std::vector<double>& coefficients, PetscInt columns, std::vector<double>& result) const {
  const auto kept = static_cast<PetscInt>(rows_.size());
  if (kept == localRows_) return flutter::multiplyAdd(values_.data(), kept, columns, coefficients, result);
  const std::size_t count = coefficients.size() / static_cast<std::size_t>(columns);
  std::vector<double> part(rows_.size() * count, 0.0);
  flutter::multiplyAdd(values_.data(), kept, columns, coefficients, part);
  for (std::size_t j = 0; j < count; ++j)
    for (std::size_t i = 0; i < rows_.size(); ++i)
      result[j * static_cast<std::size_t>(localRows_) + static_cast<std::size_t>(rows_[i])] += part[j * rows_.size() + i];
}

DenseMatrix Image::transposedProduct(MPI_Comm comm, const ReadColumns& v, PetscInt xBegin, PetscInt xEnd, PetscInt begin,
                                     PetscInt end) const {
  const auto kept = static_cast<PetscInt>(rows_.size());
  const double* image = values_.data() + begin * kept;
  if (kept == localRows_)
    return flutter::transposedProduct(comm, v.values() + xBegin * v.rows(), kept, xEnd - xBegin, image, end - begin);
  std::vector<double> x;
  x.reserve(rows_.size() * static_cast<std::size_t>(xEnd - xBegin));
  for (PetscInt j = xBegin; j < xEnd; ++j)
    for (PetscInt row : rows_) x.push_back(v.values()[j * v.rows() + row]);
  return flutter::transposedProduct(comm, x.data(), kept, xEnd - xBegin, image, end - begin);
}

}  // namespace squeal::flutter
