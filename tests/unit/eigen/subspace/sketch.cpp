// SPDX-License-Identifier: BSD-2-Clause
// Norms of vectors by their sketches.
#include "eigen/subspace/sketch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "algebra/linalg/block.hpp"
#include "algebra/linalg/qr.hpp"
#include "support/algebra/dense.hpp"
#include "support/harness/largest_error.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using linalg::DenseMatrix;
using subspace::Sketch;

constexpr PetscInt length = 3001;

/// Rows of uneven numbers: the last rank has most of them.
struct Layout {
  MPI_Comm comm;
  PetscInt first = 0, end = 0;
  explicit Layout(MPI_Comm ranks) : comm(ranks) {
    int rank = 0, size = 1;
    check(MPI_Comm_rank(comm, &rank));
    check(MPI_Comm_size(comm, &size));
    first = rank * (length / (3 * size));
    end = rank + 1 < size ? (rank + 1) * (length / (3 * size)) : length;
  }
  /// Returns this rank's rows.
  DenseMatrix local(const DenseMatrix& columns) const {
    return linalg::rowRange(columns, first, end);
  }
};

double weight(PetscInt row) { return row % 7 == 0 ? 1e3 : 1.0 / (1 + row); }

subspace::Sketch sketchOn(const Layout& layout) {
  std::vector<double> diagonal;
  for (PetscInt row = layout.first; row < layout.end; ++row) diagonal.push_back(weight(row));
  return {layout.comm, diagonal};
}

/// Returns the same columns, all rows, on all ranks.
DenseMatrix randomColumns(PetscInt count) {
  std::mt19937 generator(7);
  return test::randomMatrix(length, count, generator);
}

// Signs belong to global rows: the sketch of all ranks is that of one rank with all rows, except
// for the order of the sums.
TEST(Sketch, DoesNotDependOnTheRanks) {
  const Layout layout(PETSC_COMM_WORLD), whole(PETSC_COMM_SELF);
  const DenseMatrix columns = randomColumns(3);
  const DenseMatrix found = sketchOn(layout).of(layout.local(columns)),
                    wanted = sketchOn(whole).of(columns);
  for (const auto& sketch : {found, wanted}) {
    ASSERT_EQ(sketch.rows(), 2 * subspace::Sketch::size);
    ASSERT_EQ(sketch.columns(), 3);
  }
  double size = 0, difference = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    size = std::max(size, std::abs(wanted.entries()[i]));
    difference = test::worse(difference, std::abs(found.entries()[i] - wanted.entries()[i]));
  }
  EXPECT_LT(difference, 1e-13 * size);
}

/// Returns Σ weight · x² of each column.
std::vector<double> exactSquares(const DenseMatrix& columns, bool weighted) {
  std::vector<double> sums(columns.columns(), 0.0);
  for (PetscInt j = 0; j < columns.columns(); ++j)
    for (PetscInt i = 0; i < length; ++i)
      sums[j] += (weighted ? weight(i) : 1) * columns(i, j) * columns(i, j);
  return sums;
}

struct Spread {
  double mean = 0, deviation = 0, largest = 0;  // of estimate/exact less 1, of the squares
};

Spread spreadOf(const std::vector<double>& found, const std::vector<double>& exact) {
  Spread spread;
  const double n = found.size();
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double error = found[i] / exact.at(i) - 1;
    spread.mean += error / n;
    spread.deviation += error * error / n;
    spread.largest = test::worse(spread.largest, std::abs(error));
  }
  spread.deviation = std::sqrt(spread.deviation);
  return spread;
}

// A relative deviation of √(2/k) = 0.177 of the squares. Of 400 independent ones the mean is within
// 0.03 (three deviations), the deviation itself within 0.02 of √(2/k) (three times 0.177/√800), and
// none is off by 4.2 deviations but in one of a hundred draws of the signs, which are always the
// same. Weights of a seventh of the rows that outweigh the others leave 429 independent terms.
TEST(Sketch, NormsOfManyRandomVectors) {
  const Layout layout(PETSC_COMM_WORLD);
  const subspace::Sketch sketch = sketchOn(layout);
  constexpr int vectors = 400;
  const DenseMatrix columns = randomColumns(vectors), mine = layout.local(columns);
  const auto norms = subspace::squaredNorms(sketch.of(mine));
  const auto lengths = subspace::squaredLengths(sketch.unweighted(mine));
  ASSERT_EQ(lengths.size(), norms.euclidean.size());
  for (std::size_t i = 0; i < lengths.size(); ++i)
    EXPECT_NEAR(lengths[i], norms.euclidean[i], 1e-12 * norms.euclidean[i]);
  const double expected = std::sqrt(2.0 / subspace::Sketch::size);
  for (const bool weighted : {false, true}) {
    const auto& found = weighted ? norms.weighted : norms.euclidean;
    ASSERT_EQ(std::ssize(found), vectors);
    const auto exact = exactSquares(columns, weighted);
    const Spread spread = spreadOf(found, exact);
    int outside = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
      outside += std::sqrt(exact[i]) > subspace::Sketch::safety * std::sqrt(found[i]) ||
                 found[i] > std::pow(1 + 3 * expected / 2, 2) * exact[i];
    test::print(
        "%s: mean of the squares %+.1e, deviation %.3f (expected %.3f), largest %.2f, %d of %d "
        "outside\n",
        weighted ? "weighted" : "euclidean", spread.mean, spread.deviation, expected,
        spread.largest, outside, vectors);
    EXPECT_LT(std::abs(spread.mean), 0.03);
    EXPECT_NEAR(spread.deviation, expected, 0.02);
    EXPECT_LT(spread.largest, 4.2 * expected);
    EXPECT_LE(outside, 4);  // beyond three deviations: 0.3 % of a normal distribution, 1.1 expected
  }
}

// Vectors that are anything but random: a unit vector exactly, as signs have the square 1;
// constants, alternating signs and waves to within three deviations.
TEST(Sketch, NormsOfRegularVectors) {
  const Layout layout(PETSC_COMM_WORLD);
  const subspace::Sketch sketch = sketchOn(layout);
  DenseMatrix units(length, 3);
  for (PetscInt j = 0; j < 3; ++j) units(17 + 1000 * j, j) = 5;
  for (const double norm : subspace::squaredNorms(sketch.of(layout.local(units))).euclidean)
    EXPECT_NEAR(norm, 25, 1e-12);
  constexpr int waves[] = {0, 1, 2, 5, 20, 100, 500};
  DenseMatrix columns(length, 8);
  for (PetscInt i = 0; i < length; ++i) {
    for (PetscInt j = 0; j < 7; ++j)
      columns(i, j) = std::cos(2 * M_PI * waves[j] * (i + 0.5) / length);
    columns(i, 7) = i % 2 == 0 ? 1 : -1;
  }
  const auto found = subspace::squaredNorms(sketch.of(layout.local(columns))).euclidean;
  ASSERT_EQ(found.size(), 8u);
  EXPECT_LT(spreadOf(found, exactSquares(columns, false)).largest,
            3 * std::sqrt(2.0 / subspace::Sketch::size));
}

// Columns that are combinations of few directions except for a small rest: as many combinations as
// directions, and they hold the columns.
TEST(Sketch, LeadingCombinationsHoldTheColumns) {
  const Layout layout(PETSC_COMM_WORLD);
  const subspace::Sketch sketch = sketchOn(layout);
  constexpr PetscInt directions = 9, count = 150;
  constexpr double rest = 1e-4;
  DenseMatrix columns = randomColumns(count);
  const DenseMatrix leading = randomColumns(directions);
  std::vector<double> factors;
  for (PetscInt j = 0; j < count; ++j) {
    for (PetscInt i = 0; i < length; ++i) {
      columns(i, j) *= rest;
      for (PetscInt k = 0; k < directions; ++k)
        columns(i, j) += std::sin(1 + j * k) * leading(i, k);
    }
    factors.push_back((j % 3 == 0 ? 0.5 : 1) / std::sqrt(length / 3.0));
  }
  const auto leadingOnes =
      subspace::leadingCombinations(sketch.of(layout.local(columns)), factors, 0.03);
  ASSERT_TRUE(leadingOnes);
  const DenseMatrix& combinations = *leadingOnes;
  ASSERT_EQ(combinations.rows(), count);
  ASSERT_EQ(combinations.columns(), directions);
  // The combinations are C F V for the columns C, their factors F and orthonormal V: they hold C F
  // V Vᵀ.
  double worst = 0;
  for (PetscInt j = 0; j < count; ++j) {
    double sum = 0;
    std::vector<double> left(length, 0.0);
    for (PetscInt l = 0; l < count; ++l) {
      double kept = 0;  // (V Vᵀ) of l and j
      for (PetscInt k = 0; k < directions; ++k)
        kept += combinations(l, k) / factors[l] * combinations(j, k) / factors[j];
      const double part = factors[l] * ((l == j ? 1 : 0) - kept);
      for (PetscInt i = 0; i < length; ++i) left[i] += part * columns(i, l);
    }
    for (const double value : left) sum += value * value;
    worst = test::worse(worst, std::sqrt(sum));
  }
  test::print("left of columns of length up to 3: %.1e\n", worst);
  // The rest of each column, 1e-4 of a length of one, and that of all 150 in the rows of V, weighed
  // by the condition of the sketch.
  EXPECT_LT(worst, 5 * rest);
  // All directions different: too many for 64 numbers to tell apart.
  EXPECT_FALSE(
      subspace::leadingCombinations(sketch.of(layout.local(randomColumns(count))), factors, 0.03));
  // Few columns, all different.
  factors.resize(5);
  const auto all =
      subspace::leadingCombinations(sketch.of(layout.local(randomColumns(5))), factors, 0.03);
  ASSERT_TRUE(all);
  ASSERT_EQ(all->rows(), 5);
  ASSERT_EQ(all->columns(), 5);
  for (PetscInt j = 0; j < 5; ++j)
    for (PetscInt i = 0; i < 5; ++i) EXPECT_EQ((*all)(i, j), i == j ? factors[j] : 0);
}

// 20 directions lie in 30 random combinations of 150 columns: what a least-squares fit leaves of
// each column is rounding, times the condition of 30 random combinations, some hundreds.
TEST(Sketch, RandomCombinationsSpanTheColumns) {
  constexpr PetscInt directions = 20, count = 150, made = 30;
  const std::vector<double> factors(count, 0.5);
  std::mt19937 generator(3);
  const DenseMatrix leading = randomColumns(directions),
                    columns =
                        linalg::product(leading, test::randomMatrix(directions, count, generator));
  DenseMatrix combinations = subspace::randomCombinations(factors, 0, 20);
  combinations.append(subspace::randomCombinations(factors, 20, made));
  ASSERT_EQ(combinations.columns(), made);
  const linalg::Qr qr(linalg::product(columns, combinations));
  // The first 20 columns of Q span the directions if the combinations do.
  linalg::DenseMatrix q(qr.q().columnRange(0, directions)), left(columns);
  linalg::multiplyAdd(q, linalg::transposedProduct(q, columns), left, -1);
  EXPECT_LT(test::largestEntry(left), 1e-9);
}

// Rows that are zero may be left out.
TEST(Sketch, OfSomeRows) {
  const Layout layout(PETSC_COMM_WORLD);
  OwnedMat matrix;
  const PetscInt local = layout.end - layout.first;
  check(MatCreateAIJ(PETSC_COMM_WORLD, local, local, length, length, 1, nullptr, 0, nullptr,
                     matrix.out()));
  DenseMatrix columns = randomColumns(2);
  for (PetscInt i = 0; i < length; ++i) {
    const bool there = i % 5 == 2;
    if (there && i >= layout.first && i < layout.end)
      check(MatSetValue(matrix, i, i, 1, INSERT_VALUES));
    for (PetscInt j = 0; j < 2 && !there; ++j) columns(i, j) = 0;
  }
  check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  const linalg::RowSet rows(matrix);
  EXPECT_EQ(test::total(rows.size()), 600);  // 2, 7, … 2997
  const subspace::Sketch sketch = sketchOn(layout);
  const DenseMatrix mine = layout.local(columns), all = sketch.of(mine),
                    some = sketch.of(rows, rows.of(mine));
  ASSERT_EQ(all.rows(), some.rows());
  ASSERT_EQ(all.columns(), some.columns());
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_NEAR(all.entries()[i], some.entries()[i],
                1e-12 * std::sqrt(exactSquares(columns, true)[0]))
        << i;
}

}  // namespace
}  // namespace squeal
