// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/linalg/dense.hpp"

#include <petscblaslapack.h>

#include <numeric>

namespace squeal::linalg {
namespace {

constexpr const char *factorsFit = "the inner sizes of a product are equal",
                     *sumsFit = "a sum is of matrices of the same size";

}  // namespace

void multiplyAdd(const DenseView& x, const DenseView& coefficients, DenseMatrix& result,
                 double factor) {
  if (x.empty() || coefficients.empty()) return;
  ensure(x.columns() == coefficients.rows(), factorsFit);
  ensure(x.rows() == result.rows() && coefficients.columns() == result.columns(), sumsFit);
  const PetscBLASInt rows = x.rows(), inner = x.columns(), columns = coefficients.columns(),
                     step = 1;
  const double one = 1;
  if (columns == 1)  // GEMM would copy X first
    BLASgemv_("N", &rows, &inner, &factor, x.data(), &rows, coefficients.data(), &step, &one,
              result.data(), &step);
  else
    BLASgemm_("N", "N", &rows, &columns, &inner, &factor, x.data(), &rows, coefficients.data(),
              &inner, &one, result.data(), &rows);
}

DenseMatrix product(const DenseView& x, const DenseView& coefficients) {
  DenseMatrix result(x.rows(), coefficients.columns());
  multiplyAdd(x, coefficients, result);
  return result;
}

DenseMatrix transposedProduct(const DenseView& x, const DenseView& y) {
  ensure(x.rows() == y.rows(), factorsFit);
  DenseMatrix result(x.columns(), y.columns());
  if (x.empty() || y.empty()) return result;
  const PetscBLASInt inner = x.rows(), rows = x.columns(), columns = y.columns(), step = 1;
  const double one = 1, zero = 0;
  if (columns == 1)
    BLASgemv_("T", &inner, &rows, &one, x.data(), &inner, y.data(), &step, &zero, result.data(),
              &step);
  else
    BLASgemm_("T", "N", &rows, &columns, &inner, &one, x.data(), &inner, y.data(), &inner, &zero,
              result.data(), &rows);
  return result;
}

DenseMatrix identity(PetscInt size) {
  DenseMatrix result(size, size);
  for (PetscInt i = 0; i < size; ++i) result(i, i) = 1;
  return result;
}

DenseMatrix transposed(const DenseView& x) {
  constexpr PetscInt tile = 32;  // columns that stay in the cache while rows are written
  DenseMatrix result(x.columns(), x.rows());
  for (PetscInt first = 0; first < x.columns(); first += tile)
    for (PetscInt begin = 0; begin < x.rows(); begin += tile)
      for (PetscInt j = first; j < std::min(first + tile, x.columns()); ++j)
        for (PetscInt i = begin; i < std::min(begin + tile, x.rows()); ++i) result(j, i) = x(i, j);
  return result;
}

double squaredLength(std::span<const double> x) {
  return std::inner_product(x.begin(), x.end(), x.begin(), 0.0);
}

bool isZero(const DenseView& a) {
  return std::ranges::all_of(a.entries(), [](double entry) { return entry == 0; });
}

DenseMatrix congruent(const DenseView& a, const DenseView& c) {
  return transposedProduct(c, product(a, c));
}

DenseMatrix rowRange(const DenseView& matrix, PetscInt first, PetscInt last) {
  ensure(0 <= first && first <= last && last <= matrix.rows(), "a range of rows is in the matrix");
  DenseMatrix rows(last - first, matrix.columns());
  for (PetscInt j = 0; j < matrix.columns(); ++j)
    std::ranges::copy(matrix.column(j).subspan(first, last - first), rows.column(j).begin());
  return rows;
}

DenseMatrix bordered(const DenseView& a, const DenseView& right, const DenseView& below) {
  const PetscInt old = a.columns(), added = right.columns();
  ensure(a.rows() == old && right.rows() == old + added, "new columns have the full height");
  ensure(below.empty() || (below.rows() == added && below.columns() == old),
         "new rows lie below the old columns");
  DenseMatrix grown(old + added);
  grown.reserve(old + added);
  grown.resizeColumns(old);
  for (PetscInt j = 0; j < old; ++j) {
    std::ranges::copy(a.column(j), grown.column(j).begin());
    for (PetscInt i = 0; i < added; ++i)
      grown(old + i, j) = below.empty() ? right(j, i) : below(i, j);
  }
  grown.append(right);
  return grown;
}

void addScaled(DenseMatrix& sum, double factor, const DenseView& a) {
  ensure(a.empty() || sum.empty() || (a.rows() == sum.rows() && a.columns() == sum.columns()),
         sumsFit);
  addExtended(sum, factor, a);
}

void addExtended(DenseMatrix& sum, double factor, const DenseView& a) {
  if (a.empty()) return;
  if (sum.empty()) sum = DenseMatrix(a.rows(), a.columns());
  ensure(a.rows() <= sum.rows() && a.columns() <= sum.columns(), sumsFit);
  for (PetscInt j = 0; j < a.columns(); ++j) {
    const auto from = a.column(j);
    const auto to = sum.column(j);
    for (std::size_t i = 0; i < from.size(); ++i) to[i] += factor * from[i];
  }
}

}  // namespace squeal::linalg
