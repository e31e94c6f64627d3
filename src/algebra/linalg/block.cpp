// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/linalg/block.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/linalg/rows.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/petsc/log_events.hpp"
#include "base/petsc/object.hpp"
#include "base/system/mpi.hpp"

namespace squeal::linalg {

DenseMatrix transposedProduct(MPI_Comm comm, const DenseView& x, const DenseView& y) {
  const LoggedWork work(Work::innerProduct);
  LoggedWork::addOperations(2.0 * x.rows() * x.columns() * y.columns());
  DenseMatrix result = transposedProduct(x, y);
  mpi::sumAlike(comm, result.entries());  // later decisions must not depend on the rank
  return result;
}

DenseMatrix transposedProductWithSparse(MPI_Comm comm, const DenseView& x, const DenseView& y) {
  constexpr double few = 0.25;  // of all rows: copies of more rows cost more than they save
  std::vector<unsigned char> isUsed(y.rows());
  for (PetscInt j = 0; j < y.columns(); ++j)
    for (PetscInt i = 0; i < y.rows(); ++i) isUsed[i] |= y(i, j) != 0;
  std::vector<PetscInt> rows;
  for (PetscInt i = 0; i < y.rows(); ++i)
    if (isUsed[i]) rows.push_back(i);
  if (std::ssize(rows) > few * y.rows()) return transposedProduct(comm, x, y);
  return transposedProduct(comm, rowsOf(rows, x), rowsOf(rows, y));
}

double length(MPI_Comm comm, std::span<const double> column) {
  const DenseView view(column.data(), std::ssize(column), 1);
  return std::sqrt(transposedProduct(comm, view, view)(0, 0));
}

Block solved(KSP solver, const DenseView& columns) {
  constexpr PetscInt atOnce = 64;
  const LoggedWork work(Work::blockSolve);
  Mat matrix = nullptr;
  PetscInt size = 0;
  check(KSPGetOperators(solver, &matrix, nullptr));
  check(MatGetSize(matrix, &size, nullptr));
  const MPI_Comm comm = commOf(solver);
  Block result(columns.rows(), columns.columns());
  for (PetscInt begin = 0; begin < columns.columns(); begin += atOnce) {
    const PetscInt end = std::min(begin + atOnce, columns.columns());
    const OwnedMat rhs = borrowed(comm, size, columns.columnRange(begin, end)),
                   x = borrowed(comm, size, result.columnRange(begin, end));
    check(KSPMatSolve(solver, rhs, x));
  }
  return result;
}

void combineColumns(Block& x, const DenseMatrix& combinations) {
  constexpr PetscInt panel = 1024;  // rows; large enough for fast products
  const PetscInt rows = x.rows(), count = combinations.columns();
  ensure(count <= combinations.rows(), "combinations are at most as many as the columns");
  for (PetscInt first = 0; first < rows; first += panel) {
    const PetscInt last = std::min(first + panel, rows);
    const DenseMatrix part = product(rowRange(x, first, last), combinations);
    for (PetscInt j = 0; j < count; ++j)
      std::ranges::copy(part.column(j), x.column(j).begin() + first);
  }
  x.resizeColumns(count);
}

Block principal(MPI_Comm comm, const Block& columns, double small) {
  const PetscInt n = columns.columns();
  if (n == 0) return columns;
  DenseMatrix combinations = transposedProduct(comm, columns, columns);
  const auto sizes = symmetricEigen(combinations);
  PetscInt first = 0;
  while (first < n && !(sizes[first] > small * small)) ++first;
  return product(columns, combinations.columnRange(first, n));
}

Block unitColumns(MPI_Comm comm, const Block& columns) {
  std::vector<double> squares;
  for (PetscInt j = 0; j < columns.columns(); ++j)
    squares.push_back(squaredLength(columns.column(j)));
  mpi::sumAlike(comm, squares);
  Block units(columns.rows());
  for (PetscInt j = 0; j < columns.columns(); ++j) {
    if (!(squares[j] > 0)) continue;
    units.append(columns.column(j));
    for (double& entry : units.column(units.columns() - 1)) entry /= std::sqrt(squares[j]);
  }
  return units;
}

OwnedMat borrowed(MPI_Comm comm, PetscInt rows, const DenseView& block) {
  OwnedMat matrix;
  check(MatCreateDense(comm, block.rows(), PETSC_DECIDE, rows, block.columns(),
                       const_cast<double*>(block.data()), matrix.out()));
  return matrix;
}

RowSet::RowSet(Mat matrix, double share) {
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
  PetscInt count = 0, all = 0;
  check(ISGetSize(kept, &count));
  check(MatGetSize(matrix, &all, nullptr));
  if (count > share * all) return;
  all_ = false;
  const PetscInt* rows = nullptr;
  check(ISGetLocalSize(kept, &count));
  check(ISGetIndices(kept, &rows));
  for (PetscInt i = 0; i < count; ++i) rows_.push_back(rows[i] - firstRow_);
  check(ISRestoreIndices(kept, &rows));
}

Block RowSet::of(const DenseView& x) const { return all_ ? Block(x) : rowsOf(rows_, x); }

OwnedMat RowSet::of(Mat matrix) const {
  if (all_) {
    check(PetscObjectReference(object(matrix)));
    return OwnedMat(matrix);
  }
  const MPI_Comm comm = commOf(matrix);
  std::vector<PetscInt> global;
  for (PetscInt row : rows_) global.push_back(firstRow_ + row);
  PetscInt begin = 0, end = 0;
  check(MatGetOwnershipRangeColumn(matrix, &begin, &end));
  OwnedIS rows, columns;
  OwnedMat part;
  check(ISCreateGeneral(comm, global.size(), global.data(), PETSC_COPY_VALUES, rows.out()));
  check(ISCreateStride(comm, end - begin, begin, 1, columns.out()));
  check(MatCreateSubMatrix(matrix, rows, columns, MAT_INITIAL_MATRIX, part.out()));
  return part;
}

DenseMatrix transposedProduct(MPI_Comm comm, const RowSet& rows, const DenseView& x,
                              const DenseView& y) {
  if (rows.all()) return transposedProduct(comm, x, y);
  return transposedProduct(comm, rows.of(x), y);
}

void multiplyAdd(const RowSet& rows, const DenseView& x, const DenseView& coefficients, Block& y) {
  if (rows.all()) return multiplyAdd(x, coefficients, y);
  const Block part = product(x, coefficients);
  for (PetscInt j = 0; j < part.columns(); ++j)
    for (PetscInt i = 0; i < part.rows(); ++i) y(rows[i], j) += part(i, j);
}

}  // namespace squeal::linalg
