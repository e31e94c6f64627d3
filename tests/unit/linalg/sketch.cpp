// Norms of vectors by their sketches.
#include "linalg/sketch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "linalg/block.hpp"
#include "support/case.hpp"

namespace squeal {
namespace {

using linalg::Sketch;

constexpr PetscInt length = 3001;
constexpr int vectors = 400;

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
  /// This rank's rows of columns given by all rows.
  std::vector<double> local(const std::vector<double>& columns) const {
    std::vector<double> result;
    for (auto column = columns.begin(); column != columns.end(); column += length)
      result.insert(result.end(), column + first, column + end);
    return result;
  }
};

double weight(PetscInt row) { return row % 7 == 0 ? 1e3 : 1.0 / (1 + static_cast<double>(row)); }

linalg::Sketch sketchOn(const Layout& layout) {
  std::vector<double> diagonal;
  for (auto row = layout.first; row < layout.end; ++row) diagonal.push_back(weight(row));
  return {layout.comm, diagonal};
}

/// The same on all ranks.
std::vector<double> randomColumns(int count) {
  std::mt19937 generator(7);
  std::vector<double> values;
  for (PetscInt i = 0; i < count * length; ++i)
    values.push_back(2.0 * static_cast<double>(generator()) / 4294967295.0 - 1);
  return values;
}

/// Σ weight · x² of each column.
std::vector<double> exactSquares(const std::vector<double>& columns, bool weighted) {
  std::vector<double> sums(columns.size() / length, 0.0);
  for (std::size_t k = 0; k < columns.size(); ++k)
    sums[k / length] +=
        (weighted ? weight(static_cast<PetscInt>(k % length)) : 1) * columns[k] * columns[k];
  return sums;
}

struct Spread {
  double mean = 0, deviation = 0, largest = 0;  // of estimate/exact less 1, of the squares
};

Spread spreadOf(const std::vector<double>& found, const std::vector<double>& exact) {
  Spread spread;
  const auto n = static_cast<double>(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double error = found[i] / exact[i] - 1;
    spread.mean += error / n;
    spread.deviation += error * error / n;
    spread.largest = std::max(spread.largest, std::abs(error));
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
  const linalg::Sketch sketch = sketchOn(layout);
  const auto columns = randomColumns(vectors);
  const auto norms = linalg::squaredNorms(sketch.of(layout.local(columns).data(), vectors));
  const auto lengths =
      linalg::squaredLengths(sketch.unweighted(layout.local(columns).data(), vectors));
  ASSERT_EQ(lengths.size(), norms.euclidean.size());
  for (std::size_t i = 0; i < lengths.size(); ++i)
    EXPECT_NEAR(lengths[i], norms.euclidean[i], 1e-12 * norms.euclidean[i]);
  const double expected = std::sqrt(2.0 / linalg::Sketch::size);
  for (const bool weighted : {false, true}) {
    const auto& found = weighted ? norms.weighted : norms.euclidean;
    ASSERT_EQ(found.size(), static_cast<std::size_t>(vectors));
    const auto exact = exactSquares(columns, weighted);
    const Spread spread = spreadOf(found, exact);
    int outside = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
      outside += std::sqrt(exact[i]) > linalg::Sketch::safety * std::sqrt(found[i]) ||
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
  const linalg::Sketch sketch = sketchOn(layout);
  std::vector<double> columns(3 * length, 0.0);
  for (std::size_t k = 0; k < 3; ++k) columns[k * length + 17 + 1000 * k] = 5;
  for (const double norm :
       linalg::squaredNorms(sketch.of(layout.local(columns).data(), 3)).euclidean)
    EXPECT_NEAR(norm, 25, 1e-12);
  columns.clear();
  for (const int waves : {0, 1, 2, 5, 20, 100, 500})
    for (PetscInt i = 0; i < length; ++i)
      columns.push_back(std::cos(2 * M_PI * waves * (static_cast<double>(i) + 0.5) / length));
  for (PetscInt i = 0; i < length; ++i) columns.push_back(i % 2 == 0 ? 1 : -1);
  const auto count = static_cast<PetscInt>(columns.size()) / length;
  const auto found = linalg::squaredNorms(sketch.of(layout.local(columns).data(), count)).euclidean;
  EXPECT_LT(spreadOf(found, exactSquares(columns, false)).largest,
            3 * std::sqrt(2.0 / linalg::Sketch::size));
}

// Signs belong to global rows: the sketch of all ranks is that of one rank with all rows, but for
// the order of the sums.
TEST(Sketch, DoesNotDependOnTheRanks) {
  const Layout layout(PETSC_COMM_WORLD), whole(PETSC_COMM_SELF);
  const auto columns = randomColumns(3);
  const auto found = sketchOn(layout).of(layout.local(columns).data(), 3),
             wanted = sketchOn(whole).of(columns.data(), 3);
  ASSERT_EQ(found.size(), static_cast<std::size_t>(3 * 2 * linalg::Sketch::size));
  ASSERT_EQ(found.size(), wanted.size());
  double size = 0, difference = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    size = std::max(size, std::abs(wanted[i]));
    difference = std::max(difference, std::abs(found[i] - wanted[i]));
  }
  EXPECT_LT(difference, 1e-13 * size);
}

// Columns that are combinations of few directions but for a small rest: as many combinations as
// directions, and they hold the columns.
TEST(Sketch, LeadingCombinationsHoldTheColumns) {
  const Layout layout(PETSC_COMM_WORLD);
  const linalg::Sketch sketch = sketchOn(layout);
  constexpr PetscInt directions = 9, count = 150;
  constexpr double rest = 1e-4;
  auto columns = randomColumns(count);
  const auto leading = randomColumns(directions);
  std::vector<double> factors;
  for (PetscInt j = 0; j < count; ++j) {
    for (PetscInt i = 0; i < length; ++i) {
      auto& entry = columns[j * length + i];
      entry *= rest;
      for (PetscInt k = 0; k < directions; ++k)
        entry += std::sin(1 + j * k) * leading[k * length + i];
    }
    factors.push_back((j % 3 == 0 ? 0.5 : 1) / std::sqrt(length / 3.0));
  }
  const auto values = layout.local(columns);
  const auto combinations =
      linalg::leadingCombinations(sketch.of(values.data(), count), factors, 0.03);
  ASSERT_EQ(combinations.size(), static_cast<std::size_t>(count * directions));
  // The combinations are C F V for the columns C, their factors F and orthonormal V: they hold C F
  // V Vᵀ.
  double worst = 0;
  for (PetscInt j = 0; j < count; ++j) {
    double sum = 0;
    std::vector<double> left(static_cast<std::size_t>(length), 0.0);
    for (PetscInt l = 0; l < count; ++l) {
      double kept = 0;  // (V Vᵀ) of l and j
      for (PetscInt k = 0; k < directions; ++k)
        kept += combinations[k * count + l] / factors[l] * combinations[k * count + j] / factors[j];
      const double part = factors[l] * ((l == j ? 1 : 0) - kept);
      for (PetscInt i = 0; i < length; ++i) left[i] += part * columns[l * length + i];
    }
    for (const double value : left) sum += value * value;
    worst = std::max(worst, std::sqrt(sum));
  }
  test::print("left of columns of length up to 3: %.1e\n", worst);
  // The rest of each column, 1e-4 of a length of one, and that of all 150 in the rows of V, weighed
  // by the condition of the sketch.
  EXPECT_LT(worst, 5 * rest);
  // All directions different: too many for 64 numbers to tell apart.
  const auto all = linalg::leadingCombinations(
      sketch.of(layout.local(randomColumns(count)).data(), count), factors, 0.03);
  ASSERT_EQ(all.size(), static_cast<std::size_t>(count * count));
  for (PetscInt j = 0; j < count; ++j)
    for (PetscInt i = 0; i < count; ++i) EXPECT_EQ(all[j * count + i], i == j ? factors[j] : 0);
}

// Rows that are zero may be left out.
TEST(Sketch, OfSomeRows) {
  const Layout layout(PETSC_COMM_WORLD);
  OwnedMat matrix;
  const PetscInt local = layout.end - layout.first;
  check(MatCreateAIJ(PETSC_COMM_WORLD, local, local, length, length, 1, nullptr, 0, nullptr,
                     matrix.out()));
  auto columns = randomColumns(2);
  for (PetscInt i = 0; i < length; ++i) {
    const bool there = i % 5 == 2;
    if (there && i >= layout.first && i < layout.end)
      check(MatSetValue(matrix, i, i, 1, INSERT_VALUES));
    for (PetscInt j = 0; j < 2 && !there; ++j) columns[j * length + i] = 0;
  }
  check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  const linalg::RowSet rows(matrix);
  EXPECT_EQ(test::total(rows.size()), 600);  // 2, 7, … 2997
  const linalg::Sketch sketch = sketchOn(layout);
  const auto values = layout.local(columns);
  const auto all = sketch.of(values.data(), 2),
             some = sketch.of(rows, rows.of(values.data(), 2).data(), 2);
  ASSERT_EQ(all.size(), some.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_NEAR(all[i], some[i], 1e-12 * std::sqrt(exactSquares(columns, true)[0])) << i;
}

}  // namespace
}  // namespace squeal
