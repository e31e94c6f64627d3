// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/subspace/sketch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "algebra/linalg/symmetric.hpp"
#include "base/petsc/log_events.hpp"
#include "base/system/mpi.hpp"

namespace squeal::subspace {

using linalg::DenseMatrix;
using linalg::DenseView;
using linalg::RowSet;
using linalg::squaredLength;
using linalg::transposedProduct;

namespace {

/// Returns 64 random bits made from a counter by Splitmix64 (Steele, Lea and Flood 2014).
std::uint64_t bits(std::uint64_t counter) {
  std::uint64_t z = (counter + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace

Sketch::Sketch(MPI_Comm comm, const std::vector<double>& diagonal,
               const std::vector<PetscInt>& leftOut)
    : comm_(comm), signs_(diagonal.size(), 2 * size) {
  static_assert(size == 64, "one random word a row");
  const PetscInt rows = signs_.rows(), first = mpi::sumBefore(comm_, rows);
  const double unit = 1 / std::sqrt(size);
  for (PetscInt i = 0; i < rows; ++i) {
    std::uint64_t word = bits(first + i);
    const double weight = std::sqrt(diagonal[i]);
    for (PetscInt j = 0; j < size; ++j, word >>= 1) {
      signs_(i, j) = (word & 1) != 0 ? unit : -unit;
      signs_(i, size + j) = weight * signs_(i, j);
    }
  }
  for (const PetscInt row : leftOut)
    for (PetscInt j = 0; j < signs_.columns(); ++j) signs_(row, j) = 0;
}

DenseMatrix Sketch::of(const DenseView& x) const {
  const LoggedWork work(Work::sketch);
  return transposedProduct(comm_, signs_, x);
}

DenseMatrix Sketch::unweighted(const DenseView& x, PetscInt count) const {
  const LoggedWork work(Work::sketch);
  DenseMatrix result = transposedProduct(comm_, signs_.columnRange(0, count), x);
  const double factor = std::sqrt(double(size) / count);
  if (count < size)
    for (double& entry : result.entries()) entry *= factor;
  return result;
}

DenseMatrix Sketch::of(const RowSet& rows, const DenseView& x) const {
  const LoggedWork work(Work::sketch);
  return transposedProduct(comm_, rows, signs_, x);
}

std::vector<double> squaredLengths(const DenseView& unweighted) {
  std::vector<double> squares;
  for (PetscInt j = 0; j < unweighted.columns(); ++j)
    squares.push_back(squaredLength(unweighted.column(j)));
  return squares;
}

SquaredNorms squaredNorms(const DenseView& sketch) {
  SquaredNorms norms;
  for (PetscInt j = 0; j < sketch.columns(); ++j) {
    norms.euclidean.push_back(squaredLength(sketch.column(j).first(Sketch::size)));
    norms.weighted.push_back(squaredLength(sketch.column(j).last(Sketch::size)));
  }
  return norms;
}

std::optional<DenseMatrix> leadingCombinations(const DenseView& sketches,
                                               const std::vector<double>& factors, double small) {
  constexpr PetscInt k = Sketch::size;
  const PetscInt all = factors.size();
  DenseMatrix sketch(k, all), gram(k, k);
  for (PetscInt j = 0; j < all; ++j)
    for (PetscInt i = 0; i < k; ++i) sketch(i, j) = factors[j] * sketches(i, j);
  for (PetscInt j = 0; j < all; ++j)
    for (PetscInt a = 0; a < k; ++a)
      for (PetscInt b = 0; b < k; ++b) gram(b, a) += sketch(a, j) * sketch(b, j);
  const auto squares = symmetricEigen(gram);
  const PetscInt count =
      std::ranges::count_if(squares, [&](double square) { return square > small * small; });
  if (8 * count > 7 * k && all > count) return {};
  if (count >= all) {
    DenseMatrix diagonal(all, all);
    for (PetscInt j = 0; j < all; ++j) diagonal(j, j) = factors[j];
    return diagonal;
  }
  DenseMatrix combinations(all, count);
  for (PetscInt c = 0; c < count; ++c) {
    const auto direction = gram.column(k - 1 - c);
    for (PetscInt j = 0; j < all; ++j)
      combinations(j, c) =
          factors[j] / std::sqrt(squares[k - 1 - c]) *
          std::inner_product(direction.begin(), direction.end(), sketch.column(j).begin(), 0.0);
  }
  return combinations;
}

DenseMatrix randomCombinations(const std::vector<double>& factors, PetscInt first, PetscInt last) {
  const PetscInt all = factors.size();
  DenseMatrix combinations(all, last - first);
  for (PetscInt j = first; j < last; ++j)
    for (PetscInt i = 0; i < all; ++i) {
      const bool positive = bits(static_cast<std::uint64_t>(j) * all + i) & 1;
      combinations(i, j - first) = positive ? factors[i] : -factors[i];
    }
  return combinations;
}

}  // namespace squeal::subspace
