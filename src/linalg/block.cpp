#include "linalg/block.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <petscblaslapack.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "linalg/symmetric.hpp"

namespace squeal::linalg {

void append(Block& block, const Block& other) {
  block.values.insert(block.values.end(), other.values.begin(), other.values.end());
  block.columns += other.columns;
}

void multiplyAdd(const double* x, PetscInt rowCount, PetscInt columnCount,
                 const std::vector<double>& coefficients, std::vector<double>& result,
                 double factor) {
  PetscBLASInt rows = rowCount, inner = columnCount,
               columns = static_cast<PetscBLASInt>(coefficients.size() /
                                                   static_cast<std::size_t>(columnCount));
  const PetscScalar one = 1;
  if (rows > 0 && columns > 0)
    BLASgemm_("N", "N", &rows, &columns, &inner, &factor, x, &rows, coefficients.data(), &inner,
              &one, result.data(), &rows);
}

DenseMatrix transposedProduct(MPI_Comm comm, const double* x, PetscInt rowCount, PetscInt m,
                              const double* y, PetscInt n) {
  DenseMatrix product(static_cast<std::size_t>(m) * static_cast<std::size_t>(n), 0.0);
  PetscBLASInt rows = rowCount, left = m, right = n;
  const PetscScalar one = 1, zero = 0;
  if (rows > 0 && m > 0 && n > 0)
    BLASgemm_("T", "N", &left, &right, &rows, &one, x, &rows, y, &rows, &zero, product.data(),
              &left);
  const auto count = static_cast<int>(product.size());
  check(MPI_Allreduce(MPI_IN_PLACE, product.data(), count, MPI_DOUBLE, MPI_SUM, comm));
  // The rounding of sums over the ranks may depend on the rank; later decisions must not.
  check(MPI_Bcast(product.data(), count, MPI_DOUBLE, 0, comm));
  return product;
}

DenseMatrix transposedProduct(MPI_Comm comm, const Block& x, const Block& y) {
  return transposedProduct(comm, x.values.data(), x.rows, x.columns, y.values.data(), y.columns);
}

Block combined(const Block& x, const DenseMatrix& combinations, PetscInt count) {
  Block result(x.rows, count);
  multiplyAdd(x.values.data(), x.rows, x.columns, combinations, result.values);
  return result;
}

DenseMatrix congruent(const DenseMatrix& a, PetscInt size, const DenseMatrix& c) {
  const auto count = static_cast<PetscInt>(c.size()) / size;
  DenseMatrix image(c.size());
  multiplyAdd(a.data(), size, size, c, image);
  return transposedProduct(MPI_COMM_SELF, c.data(), size, count, image.data(), count);
}

DenseMatrix rowsOf(const DenseMatrix& matrix, std::size_t height, std::size_t first,
                   std::size_t count) {
  DenseMatrix rows;
  if (matrix.empty()) return rows;
  rows.reserve(matrix.size() / height * count);
  for (auto column = matrix.begin(); column != matrix.end();
       column += static_cast<std::ptrdiff_t>(height)) {
    const auto begin = column + static_cast<std::ptrdiff_t>(first);
    rows.insert(rows.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
  }
  return rows;
}

Block principal(MPI_Comm comm, const Block& columns, double small) {
  if (columns.columns == 0) return columns;
  DenseMatrix combinations = transposedProduct(comm, columns, columns);
  const auto sizes = symmetricEigen(combinations, static_cast<int>(columns.columns));
  const auto n = static_cast<std::size_t>(columns.columns);
  std::size_t first = 0;
  while (first < n && !(sizes[first] > small * small)) ++first;
  combinations.erase(combinations.begin(), combinations.begin() + first * n);
  return combined(columns, combinations, static_cast<PetscInt>(n - first));
}

Block unitColumns(MPI_Comm comm, const Block& columns) {
  std::vector<double> squares;
  for (PetscInt j = 0; j < columns.columns; ++j)
    squares.push_back(std::inner_product(columns.column(j), columns.column(j) + columns.rows,
                                         columns.column(j), 0.0));
  check(MPI_Allreduce(MPI_IN_PLACE, squares.data(), static_cast<int>(squares.size()), MPI_DOUBLE,
                      MPI_SUM, comm));
  check(MPI_Bcast(squares.data(), static_cast<int>(squares.size()), MPI_DOUBLE, 0, comm));
  Block units(columns.rows);
  for (PetscInt j = 0; j < columns.columns; ++j)
    if (const double square = squares[j]; square > 0)
      units.append(columns.column(j), 1 / std::sqrt(square));
  return units;
}

OwnedMat borrowed(MPI_Comm comm, PetscInt localRows, PetscInt rows, PetscInt columns,
                  const double* values) {
  OwnedMat matrix;
  check(MatCreateDense(comm, localRows, PETSC_DECIDE, rows, columns, const_cast<double*>(values),
                       matrix.out()));
  return matrix;
}

void appendProduct(Mat matrix, const double* columns, PetscInt count, Block& result) {
  PetscInt localRows = 0, localColumns = 0, rows = 0, length = 0;
  check(MatGetLocalSize(matrix, &localRows, &localColumns));
  check(MatGetSize(matrix, &rows, &length));
  if (count == 0) return;
  result.values.resize(result.values.size() +
                       static_cast<std::size_t>(localRows) * static_cast<std::size_t>(count));
  const PetscInt first = result.columns;
  result.columns += count;
  if (rows == 0) return;
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(matrix));
  const OwnedMat from = borrowed(comm, localColumns, length, count, columns),
                 to = borrowed(comm, localRows, rows, count, result.column(first));
  PetscBool assembled = PETSC_FALSE;
  check(MatHasOperation(matrix, MATOP_GET_ROW, &assembled));
  if (assembled) {
    check(MatProductCreateWithMat(matrix, from, nullptr, to));
    check(MatProductSetType(to, MATPRODUCT_AB));
    check(MatProductSetFromOptions(to));
    check(MatProductSymbolic(to));
    check(MatProductNumeric(to));
    return;
  }
  for (PetscInt j = 0; j < count; ++j) {
    Vec column = nullptr, image = nullptr;
    check(MatDenseGetColumnVecRead(from, j, &column));
    check(MatDenseGetColumnVecWrite(to, j, &image));
    check(MatMult(matrix, column, image));
    check(MatDenseRestoreColumnVecWrite(to, j, &image));
    check(MatDenseRestoreColumnVecRead(from, j, &column));
  }
}

RowSet::RowSet(Mat matrix) {
  PetscInt end = 0;
  check(MatGetOwnershipRange(matrix, &firstRow_, &end));
  localRows_ = end - firstRow_;
  PetscBool known = PETSC_FALSE;
  check(MatHasOperation(matrix, MATOP_FIND_NONZERO_ROWS, &known));
  if (!known) return;
  IS kept = nullptr;
  check(MatFindNonzeroRows(matrix, &kept));
  if (!kept) return;
  const OwnedIS owner(kept);
  all_ = false;
  PetscInt count = 0;
  const PetscInt* rows = nullptr;
  check(ISGetLocalSize(kept, &count));
  check(ISGetIndices(kept, &rows));
  for (PetscInt i = 0; i < count; ++i) rows_.push_back(rows[i] - firstRow_);
  check(ISRestoreIndices(kept, &rows));
}

std::vector<double> RowSet::of(const double* columns, PetscInt count) const {
  if (all_) return {columns, columns + static_cast<std::ptrdiff_t>(count) * localRows_};
  std::vector<double> values;
  values.reserve(rows_.size() * static_cast<std::size_t>(count));
  for (PetscInt j = 0; j < count; ++j)
    for (PetscInt row : rows_)
      values.push_back(columns[static_cast<std::ptrdiff_t>(j) * localRows_ + row]);
  return values;
}

Block RowSet::of(const Block& columns, PetscInt first, PetscInt last) const {
  Block some(size());
  some.values = of(columns.column(first), last - first);
  some.columns = last - first;
  return some;
}

OwnedMat RowSet::of(Mat matrix) const {
  if (all_) {
    check(PetscObjectReference(reinterpret_cast<PetscObject>(matrix)));
    return OwnedMat(matrix);
  }
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(matrix));
  std::vector<PetscInt> global;
  for (PetscInt row : rows_) global.push_back(firstRow_ + row);
  PetscInt begin = 0, end = 0;
  check(MatGetOwnershipRangeColumn(matrix, &begin, &end));
  OwnedIS rows, columns;
  OwnedMat part;
  check(ISCreateGeneral(comm, static_cast<PetscInt>(global.size()), global.data(),
                        PETSC_COPY_VALUES, rows.out()));
  check(ISCreateStride(comm, end - begin, begin, 1, columns.out()));
  check(MatCreateSubMatrix(matrix, rows, columns, MAT_INITIAL_MATRIX, part.out()));
  return part;
}

DenseMatrix transposedProduct(MPI_Comm comm, const RowSet& rows, const double* x, PetscInt m,
                              const double* y, PetscInt n) {
  if (rows.all()) return transposedProduct(comm, x, rows.size(), m, y, n);
  return transposedProduct(comm, rows.of(x, m).data(), rows.size(), m, y, n);
}

void multiplyAdd(const RowSet& rows, const Block& x, const std::vector<double>& coefficients,
                 std::vector<double>& y) {
  if (rows.all()) return multiplyAdd(x.values.data(), x.rows, x.columns, coefficients, y);
  const auto count = static_cast<PetscInt>(coefficients.size()) / x.columns;
  Block part(x.rows, count);
  multiplyAdd(x.values.data(), x.rows, x.columns, coefficients, part.values);
  for (PetscInt j = 0; j < count; ++j) {
    double* column = y.data() + static_cast<std::ptrdiff_t>(j) * rows.localRows();
    for (PetscInt i = 0; i < x.rows; ++i) column[rows[i]] += part.column(j)[i];
  }
}

}  // namespace squeal::linalg
