// SPDX-License-Identifier: BSD-2-Clause
// The dense matrix, its parts and its products, against numbers known by hand.
#include "algebra/linalg/dense.hpp"

#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "algebra/linalg/symmetric.hpp"
#include "support/algebra/dense.hpp"
#include "support/model/model.hpp"

namespace squeal {
namespace {

using linalg::DenseMatrix;
using linalg::DenseView;
using test::square;

std::vector<double> list(std::span<const double> entries) {
  return {entries.begin(), entries.end()};
}

/// Checks the shape and all entries, which are given column by column.
void expectMatrix(const DenseView& found, PetscInt rows, PetscInt columns,
                  const std::vector<double>& entries) {
  EXPECT_EQ(found.rows(), rows);
  EXPECT_EQ(found.columns(), columns);
  EXPECT_EQ(list(found.entries()), entries);
}

/// Returns [1 3 5; 2 4 6].
DenseMatrix twoByThree() { return {2, 3, {1, 2, 3, 4, 5, 6}}; }

TEST(Dense, SubscriptsAndColumns) {
  DenseMatrix a = twoByThree();
  const DenseMatrix& constant = a;
  const DenseView view = a;
  for (PetscInt j = 0; j < 3; ++j) {
    for (PetscInt i = 0; i < 2; ++i) {
      EXPECT_EQ(constant(i, j), 1 + i + 2 * j);
      EXPECT_EQ(view(i, j), 1 + i + 2 * j);
    }
    EXPECT_EQ(list(constant.column(j)), (std::vector<double>{1.0 + 2 * j, 2.0 + 2 * j}));
    EXPECT_EQ(list(view.column(j)), list(constant.column(j)));
  }
  a(1, 2) = 7;
  a.column(0)[1] = 8;
  expectMatrix(a, 2, 3, {1, 8, 3, 4, 5, 7});
  EXPECT_EQ(a.size(), 6u);
  EXPECT_EQ(view.size(), 6u);
  EXPECT_FALSE(a.empty() || view.empty());
}

TEST(Dense, IsMadeOfZerosOrOfAView) {
  expectMatrix(DenseMatrix(2, 3), 2, 3, {0, 0, 0, 0, 0, 0});
  expectMatrix(DenseMatrix(2), 2, 0, {});
  expectMatrix(DenseMatrix(), 0, 0, {});
  const DenseMatrix a = twoByThree();
  DenseMatrix copy{DenseView(a)};
  copy(0, 0) = 9;
  expectMatrix(copy, 2, 3, {9, 2, 3, 4, 5, 6});
  expectMatrix(a, 2, 3, {1, 2, 3, 4, 5, 6});
}

TEST(Dense, RangesOfColumns) {
  const DenseMatrix a = twoByThree();
  expectMatrix(a.columnRange(1, 3), 2, 2, {3, 4, 5, 6});
  expectMatrix(a.columnRange(0, 1), 2, 1, {1, 2});
  expectMatrix(DenseView(a).columnRange(1, 3).columnRange(1, 2), 2, 1, {5, 6});
  for (PetscInt j = 0; j <= 3; ++j) {
    expectMatrix(a.columnRange(j, j), 2, 0, {});
    EXPECT_TRUE(a.columnRange(j, j).empty());
  }
}

TEST(Dense, AppendsMatricesAndColumns) {
  DenseMatrix a = twoByThree();
  a.append(DenseMatrix(2, 2, {7, 8, 9, 10}));
  a.append(std::vector<double>{11, 12});
  expectMatrix(a, 2, 6, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  a.append(DenseMatrix(2, 0));
  EXPECT_EQ(a.columns(), 6);
  DenseMatrix empty;
  empty.append(twoByThree());
  expectMatrix(empty, 2, 3, {1, 2, 3, 4, 5, 6});
  DenseMatrix rowsOnly(2);
  rowsOnly.append(std::vector<double>{1, 2});
  expectMatrix(rowsOnly, 2, 1, {1, 2});
}

TEST(Dense, ResizeAppendsZerosOrDropsColumns) {
  DenseMatrix a = twoByThree();
  a.resizeColumns(2);
  expectMatrix(a, 2, 2, {1, 2, 3, 4});
  a.resizeColumns(3);  // what has been dropped does not come back
  expectMatrix(a, 2, 3, {1, 2, 3, 4, 0, 0});
  a.resizeColumns(0);
  expectMatrix(a, 2, 0, {});
  a.resizeColumns(1);
  expectMatrix(a, 2, 1, {0, 0});
}

TEST(Dense, GrowsInPlaceWithinTheRoomReserved) {
  DenseMatrix a = twoByThree();
  a.reserve(5);
  const double* const before = a.data();
  expectMatrix(a, 2, 3, {1, 2, 3, 4, 5, 6});
  a.append(std::vector<double>{7, 8});
  a.resizeColumns(5);
  EXPECT_EQ(a.data(), before);
  expectMatrix(a, 2, 5, {1, 2, 3, 4, 5, 6, 7, 8, 0, 0});
}

// As a rank has it on which a tall matrix has no rows: the columns count nevertheless.
TEST(Dense, WithoutRows) {
  DenseMatrix a(0, 3);
  EXPECT_TRUE(a.empty() && DenseView(a).empty());
  EXPECT_EQ(a.column(2).size(), 0u);
  expectMatrix(a.columnRange(1, 3), 0, 2, {});
  a.append(DenseMatrix(0, 2));
  expectMatrix(a, 0, 5, {});
  a.append(std::span<const double>());
  expectMatrix(a, 0, 6, {});
  a.resizeColumns(4);
  expectMatrix(a, 0, 4, {});
  expectMatrix(linalg::product(a, DenseMatrix(4, 2)), 0, 2, {});
  expectMatrix(linalg::transposedProduct(a, DenseMatrix(0, 2)), 4, 2, std::vector<double>(8));
  expectMatrix(linalg::rowRange(a, 0, 0), 0, 4, {});
}

TEST(Dense, Identity) {
  expectMatrix(linalg::identity(2), 2, 2, {1, 0, 0, 1});
  EXPECT_TRUE(linalg::identity(0).empty());
}

// [1 3 5; 2 4 6] · [1 0; 0 1; 1 −1] = [6 −2; 8 −2].
TEST(Dense, Product) {
  const DenseMatrix a = twoByThree(), c(3, 2, {1, 0, 1, 0, 1, -1});
  expectMatrix(linalg::product(a, c), 2, 2, {6, 8, -2, -2});
  expectMatrix(linalg::product(a.columnRange(1, 3), square({0, 1, 2, 0})), 2, 2, {5, 6, 6, 8});
  expectMatrix(linalg::product(a, DenseMatrix(3, 0)), 2, 0, {});
  expectMatrix(linalg::product(DenseMatrix(2, 0), DenseMatrix(0, 3)), 2, 3, {0, 0, 0, 0, 0, 0});
}

TEST(Dense, MultiplyAdd) {
  const DenseMatrix a = twoByThree(), c(3, 1, {1, 0, 1});
  DenseMatrix sum(2, 1, {100, 200});
  linalg::multiplyAdd(a, c, sum);
  expectMatrix(sum, 2, 1, {106, 208});
  linalg::multiplyAdd(a, c, sum, -2);
  expectMatrix(sum, 2, 1, {94, 192});
  linalg::multiplyAdd(DenseMatrix(2, 0), DenseMatrix(0, 1), sum);
  expectMatrix(sum, 2, 1, {94, 192});
}

// [1 2; 3 4; 5 6] · [1; 10] = [21; 43; 65].
TEST(Dense, TransposedProduct) {
  const DenseMatrix a = twoByThree();
  expectMatrix(linalg::transposedProduct(a, DenseMatrix(2, 1, {1, 10})), 3, 1, {21, 43, 65});
  expectMatrix(linalg::transposedProduct(a, a), 3, 3, {5, 11, 17, 11, 25, 39, 17, 39, 61});
  expectMatrix(linalg::transposedProduct(a, DenseMatrix(2)), 3, 0, {});
  expectMatrix(linalg::transposedProduct(DenseMatrix(2), a), 0, 3, {});
}

// A = [1 3; 2 4] is not symmetric: with C = [1 3 5; 2 4 6] the product A C is [7 15 23; 10 22 34].
TEST(Dense, Congruent) {
  expectMatrix(linalg::congruent(square({1, 2, 3, 4}), twoByThree()), 3, 3,
               {27, 61, 95, 59, 133, 207, 91, 205, 319});
  expectMatrix(linalg::congruent(square({1, 2, 3, 4}), DenseMatrix(2)), 0, 0, {});
}

TEST(Dense, RangesOfRows) {
  const DenseMatrix a(3, 2, {1, 2, 3, 4, 5, 6});
  expectMatrix(linalg::rowRange(a, 1, 3), 2, 2, {2, 3, 5, 6});
  expectMatrix(linalg::rowRange(a, 0, 1), 1, 2, {1, 4});
  expectMatrix(linalg::rowRange(a, 3, 3), 0, 2, {});
  expectMatrix(linalg::rowRange(a, 0, 3), 3, 2, {1, 2, 3, 4, 5, 6});
}

// [1 3; 2 4] grows by the column (5, 6, 7), and by the row (8, 9) or that of the symmetric matrix.
TEST(Dense, Bordered) {
  const DenseMatrix a = square({1, 2, 3, 4}), right(3, 1, {5, 6, 7}), below(1, 2, {8, 9}), none;
  expectMatrix(linalg::bordered(a, right, below), 3, 3, {1, 2, 8, 3, 4, 9, 5, 6, 7});
  expectMatrix(linalg::bordered(a, right, none), 3, 3, {1, 2, 5, 3, 4, 6, 5, 6, 7});
  // Two new columns with all entries different: the corner is that of `right`.
  const DenseMatrix two(4, 2, {5, 6, 7, 8, 9, 10, 11, 12});
  expectMatrix(linalg::bordered(a, two, none), 4, 4,
               {1, 2, 5, 9, 3, 4, 6, 10, 5, 6, 7, 8, 9, 10, 11, 12});
  expectMatrix(linalg::bordered(a, DenseMatrix(2), none), 2, 2, {1, 2, 3, 4});
  expectMatrix(linalg::bordered(none, a, none), 2, 2, {1, 2, 3, 4});
}

TEST(Dense, AddScaled) {
  DenseMatrix sum = square({1, 2, 3, 4});
  linalg::addScaled(sum, 2, square({10, 20, 30, 40}));
  expectMatrix(sum, 2, 2, {21, 42, 63, 84});
  linalg::addExtended(sum, -1, square({1}));  // extended by zeros
  expectMatrix(sum, 2, 2, {20, 42, 63, 84});
  linalg::addExtended(sum, 3, DenseMatrix(1, 2, {1, 1}));
  expectMatrix(sum, 2, 2, {23, 42, 66, 84});
  linalg::addScaled(sum, 5, DenseMatrix());  // zero
  expectMatrix(sum, 2, 2, {23, 42, 66, 84});
  DenseMatrix zero;
  linalg::addScaled(zero, -1, twoByThree());
  expectMatrix(zero, 2, 3, {-1, -2, -3, -4, -5, -6});
  DenseMatrix none;
  linalg::addScaled(none, 1, DenseMatrix());
  expectMatrix(none, 0, 0, {});
}

TEST(Dense, OfComplexNumbers) {
  linalg::ComplexMatrix a(1, 2);
  a(0, 1) = {3, 4};
  a.append(std::vector<Complex>{{5, 6}});
  EXPECT_EQ(a.columns(), 3);
  EXPECT_EQ(a(0, 0), 0.0);
  EXPECT_EQ(a.column(1)[0], Complex(3, 4));
  EXPECT_EQ(a(0, 2), Complex(5, 6));
}

TEST(Dense, KeepsItsRowsWhereNoColumnsAreAppended) {
  DenseMatrix matrix(3);
  matrix.append(DenseMatrix());
  EXPECT_EQ(matrix.rows(), 3);
  EXPECT_EQ(matrix.columns(), 0);
}

// LAPACK returns NaN for such a matrix, and no error.
TEST(Dense, EigenvaluesOfEntriesThatAreNoNumbersAreRefused) {
  DenseMatrix matrix = test::square({1, NAN, NAN, 1});
  EXPECT_NE(test::errorOf([&] { linalg::symmetricEigen(matrix); }), "");
}

}  // namespace
}  // namespace squeal
