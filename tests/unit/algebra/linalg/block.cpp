// SPDX-License-Identifier: BSD-2-Clause
// Tall matrices distributed by rows, with all rows on the last rank and with rows on every rank.
#include "algebra/linalg/block.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "support/algebra/dense.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using linalg::Block;
using linalg::DenseMatrix;
using linalg::DenseView;

constexpr PetscInt size = 6;

/// This rank's rows of `size`.
struct Layout {
  PetscInt first, end;
  DenseMatrix local(const DenseMatrix& x) const { return linalg::rowRange(x, first, end); }
};

/// All rows on the last rank, then equal parts.
std::vector<Layout> layouts() {
  int rank = 0, ranks = 1;
  check(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  check(MPI_Comm_size(PETSC_COMM_WORLD, &ranks));
  return {{0, rank + 1 < ranks ? 0 : size}, {rank * size / ranks, (rank + 1) * size / ranks}};
}

/// Checks all entries of matrices that differ by rounding.
void expectNear(const DenseView& found, const DenseView& wanted, double tolerance = 1e-13) {
  ASSERT_EQ(found.rows(), wanted.rows());
  ASSERT_EQ(found.columns(), wanted.columns());
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_NEAR(found.entries()[k], wanted.entries()[k], tolerance) << k;
}

/// Returns the same columns, all rows, on all ranks.
DenseMatrix columns(PetscInt count, unsigned seed) {
  std::mt19937 generator(seed);
  return test::randomMatrix(size, count, generator);
}

TEST(Block, ProductsOfAllRows) {
  const DenseMatrix x = columns(3, 1), y = columns(2, 2);
  for (const Layout& layout : layouts()) {
    expectNear(linalg::transposedProduct(PETSC_COMM_WORLD, layout.local(x), layout.local(y)),
               linalg::transposedProduct(x, y));
    expectNear(
        linalg::transposedProduct(PETSC_COMM_WORLD, layout.local(x), layout.local(columns(0, 1))),
        DenseMatrix(3, 0));
  }
}

/// Returns a matrix with the entry 1 + i + 10 j at (i, j) of every row i with i % 3 == 1.
OwnedMat someRows(const Layout& layout) {
  OwnedMat matrix;
  const PetscInt local = layout.end - layout.first;
  check(MatCreateAIJ(PETSC_COMM_WORLD, local, local, size, size, size, nullptr, size, nullptr,
                     matrix.out()));
  for (PetscInt i = layout.first; i < layout.end; ++i)
    for (PetscInt j = 0; j < size && i % 3 == 1; ++j)
      check(MatSetValue(matrix, i, j, 1 + i + 10 * j, INSERT_VALUES));
  check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  return matrix;
}

DenseMatrix allOfSomeRows() {
  DenseMatrix matrix(size, size);
  for (PetscInt j = 0; j < size; ++j)
    for (PetscInt i = 1; i < size; i += 3) matrix(i, j) = 1 + i + 10 * j;
  return matrix;
}

// The matrix itself, and as an operator that cannot give its rows.
TEST(Block, AppendsTheProductsOfAMatrix) {
  const DenseMatrix x = columns(3, 1), image = linalg::product(allOfSomeRows(), x);
  for (const Layout& layout : layouts()) {
    const OwnedMat matrix = someRows(layout);
    OwnedMat transposed, twice;
    check(MatCreateTranspose(matrix, transposed.out()));
    check(MatCreateTranspose(transposed, twice.out()));
    PetscBool givesRows = PETSC_TRUE;
    check(MatHasOperation(twice, MATOP_GET_ROW, &givesRows));
    EXPECT_FALSE(givesRows);
    for (Mat a : {matrix.get(), twice.get()}) {
      Block result = layout.local(columns(1, 3));
      linalg::appendProduct(a, layout.local(x), result);
      linalg::appendProduct(a, layout.local(columns(0, 1)), result);
      DenseMatrix wanted = columns(1, 3);
      wanted.append(image);
      expectNear(result, layout.local(wanted), 1e-12);
    }
  }
}

/// Returns the entry (i, j) of a matrix with a row in three without entries.
double sparseEntry(PetscInt i, PetscInt j) {
  return i % 3 == 1 || (i + 2 * j) % 4 == 0 ? 0 : std::sin(1.0 + i + 10 * j);
}

// Columns that fill several tiles and a part of one. The sums have at most `size` products of
// numbers up to 1, so that 1e-14 is some ten units of round-off.
TEST(Block, AppendsProductsOfManyColumns) {
  DenseMatrix a(size, size);
  for (PetscInt j = 0; j < size; ++j)
    for (PetscInt i = 0; i < size; ++i) a(i, j) = sparseEntry(i, j);
  for (const Layout& layout : layouts()) {
    OwnedMat matrix;
    const PetscInt local = layout.end - layout.first;
    check(MatCreateAIJ(PETSC_COMM_WORLD, local, local, size, size, size, nullptr, size, nullptr,
                       matrix.out()));
    for (PetscInt i = layout.first; i < layout.end; ++i)
      for (PetscInt j = 0; j < size; ++j)
        if (a(i, j) != 0) check(MatSetValue(matrix, i, j, a(i, j), INSERT_VALUES));
    check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
    for (const PetscInt count : {1, 8, 15, 24, 32, 77}) {
      const DenseMatrix x = columns(count, 6);
      Block result(local);
      linalg::appendProduct(matrix, layout.local(x), result);
      expectNear(result, layout.local(linalg::product(a, x)), 1e-14);
    }
  }
}

// The unknowns of other ranks that a product needs are known from the last one, until the pattern
// of the matrix changes.
TEST(Block, ProductsFollowThePatternOfTheMatrix) {
  const DenseMatrix x = columns(5, 7);
  const Layout layout = layouts().back();
  const PetscInt local = layout.end - layout.first;
  OwnedMat matrix;
  check(MatCreateAIJ(PETSC_COMM_WORLD, local, local, size, size, size, nullptr, size, nullptr,
                     matrix.out()));
  check(MatSetOption(matrix, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  DenseMatrix a(size, size);
  for (PetscInt shift = 0; shift < 3; ++shift) {  // first the diagonal, then neighbours
    for (PetscInt i = 0; i < size; ++i) {
      const PetscInt j = (i + 2 * shift) % size;
      a(i, j) += 1 + i + shift;
      if (i >= layout.first && i < layout.end)
        check(MatSetValue(matrix, i, j, 1 + i + shift, ADD_VALUES));
    }
    check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
    Block result(local);
    linalg::appendProduct(matrix, layout.local(x), result);
    expectNear(result, layout.local(linalg::product(a, x)), 1e-13);
  }
}

TEST(Block, SetsOfRows) {
  const DenseMatrix x = columns(2, 4), y = linalg::product(allOfSomeRows(), columns(3, 5)),
                    c = test::square({1, 2, 3, 4});
  for (const Layout& layout : layouts()) {
    const OwnedMat matrix = someRows(layout);
    const linalg::RowSet rows(matrix);
    EXPECT_FALSE(rows.all());
    EXPECT_EQ(rows.localRows(), layout.end - layout.first);
    EXPECT_EQ(test::total(rows.size()), 2);  // rows 1 and 4
    EXPECT_FALSE(linalg::RowSet(matrix, 2.1 / size).all());
    EXPECT_TRUE(linalg::RowSet(matrix, 1.9 / size).all());
    for (PetscInt k = 0; k < rows.size(); ++k) EXPECT_EQ((layout.first + rows[k]) % 3, 1);
    const Block part = rows.of(layout.local(y));
    EXPECT_EQ(part.rows(), rows.size());
    expectNear(linalg::transposedProduct(PETSC_COMM_WORLD, rows, layout.local(x), part),
               linalg::transposedProduct(x, y));
    Block sum = layout.local(x);
    linalg::multiplyAdd(rows, part.columnRange(0, 2), c, sum);
    DenseMatrix wanted = x;
    linalg::multiplyAdd(y.columnRange(0, 2), c, wanted);
    expectNear(sum, layout.local(wanted));
    const OwnedMat kept = rows.of(matrix);
    PetscInt count = 0;
    check(MatGetSize(kept, &count, nullptr));
    EXPECT_EQ(count, 2);
  }
}

// [3 0 0; 4 0 2; 0 0 0 …]: the lengths are 5, 0 and 2.
TEST(Block, UnitColumns) {
  DenseMatrix x(size, 3);
  x(0, 0) = 3, x(1, 0) = 4, x(1, 2) = 2;
  DenseMatrix wanted(size, 2);
  wanted(0, 0) = 0.6, wanted(1, 0) = 0.8, wanted(1, 1) = 1;
  for (const Layout& layout : layouts())
    expectNear(linalg::unitColumns(PETSC_COMM_WORLD, layout.local(x)), layout.local(wanted));
}

// Columns (2, 0, …), (0, 1e-3, …) and (2, 0, …): the principal directions have the lengths 1e-3 and
// 2√2, and one of them is zero.
TEST(Block, PrincipalDirections) {
  DenseMatrix x(size, 3);
  x(0, 0) = 2, x(1, 1) = 1e-3, x(0, 2) = 2;
  for (const Layout& layout : layouts()) {
    const auto lengths = [&](double small) {
      const Block found = linalg::principal(PETSC_COMM_WORLD, layout.local(x), small);
      EXPECT_EQ(found.rows(), layout.end - layout.first);
      return linalg::transposedProduct(PETSC_COMM_WORLD, found, found);
    };
    expectNear(lengths(1e-4), test::square({1e-6, 0, 0, 8}));
    expectNear(lengths(1e-2), test::square({8}));
    EXPECT_EQ(lengths(3).columns(), 0);
    EXPECT_EQ(linalg::principal(PETSC_COMM_WORLD, Block(layout.end - layout.first), 1).columns(),
              0);
  }
}

}  // namespace
}  // namespace squeal
