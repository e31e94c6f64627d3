#include "linalg/sketch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "linalg/symmetric.hpp"

namespace squeal::linalg {
namespace {

/// Returns 64 random bits made from a counter by Splitmix64 (Steele, Lea and Flood 2014).
std::uint64_t bits(std::uint64_t counter) {
  std::uint64_t z = (counter + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace

Sketch::Sketch(MPI_Comm comm, const std::vector<double>& diagonal)
    : comm_(comm), signs_(static_cast<PetscInt>(diagonal.size()), 2 * size) {
  static_assert(size == 64, "one random word a row");
  PetscInt first = 0;
  const PetscInt rows = signs_.rows;
  check(MPI_Exscan(&rows, &first, 1, MPIU_INT, MPI_SUM, comm_));
  const double unit = 1 / std::sqrt(static_cast<double>(size));
  for (PetscInt i = 0; i < rows; ++i) {
    std::uint64_t word = bits(static_cast<std::uint64_t>(first + i));
    const double weight = std::sqrt(diagonal[i]);
    for (PetscInt j = 0; j < size; ++j, word >>= 1) {
      signs_.column(j)[i] = (word & 1) != 0 ? unit : -unit;
      signs_.column(size + j)[i] = weight * signs_.column(j)[i];
    }
  }
}

DenseMatrix Sketch::of(const double* x, PetscInt columns) const {
  return transposedProduct(comm_, signs_.values.data(), signs_.rows, 2 * size, x, columns);
}

DenseMatrix Sketch::unweighted(const double* x, PetscInt columns) const {
  return transposedProduct(comm_, signs_.values.data(), signs_.rows, size, x, columns);
}

DenseMatrix Sketch::of(const RowSet& rows, const double* x, PetscInt columns) const {
  return transposedProduct(comm_, rows, signs_.values.data(), 2 * size, x, columns);
}

std::vector<double> squaredLengths(const DenseMatrix& unweighted) {
  std::vector<double> squares;
  for (auto column = unweighted.begin(); column != unweighted.end(); column += Sketch::size)
    squares.push_back(std::inner_product(column, column + Sketch::size, column, 0.0));
  return squares;
}

SquaredNorms squaredNorms(const DenseMatrix& sketch) {
  SquaredNorms norms;
  const auto halves = squaredLengths(sketch);  // two per column: unweighted, weighted
  for (std::size_t j = 0; j < halves.size(); j += 2) {
    norms.euclidean.push_back(halves[j]);
    norms.weighted.push_back(halves[j + 1]);
  }
  return norms;
}

DenseMatrix leadingCombinations(const DenseMatrix& sketches, const std::vector<double>& factors,
                                double small) {
  constexpr auto k = static_cast<std::size_t>(Sketch::size);
  const std::size_t all = factors.size();
  DenseMatrix sketch(k * all), gram(k * k);
  for (std::size_t j = 0; j < all; ++j)
    for (std::size_t i = 0; i < k; ++i) sketch[j * k + i] = factors[j] * sketches[2 * j * k + i];
  for (std::size_t j = 0; j < all; ++j)
    for (std::size_t a = 0; a < k; ++a)
      for (std::size_t b = 0; b < k; ++b) gram[a * k + b] += sketch[j * k + a] * sketch[j * k + b];
  const auto squares = symmetricEigen(gram, static_cast<int>(k));
  const auto count = static_cast<std::size_t>(std::count_if(
      squares.begin(), squares.end(), [&](double square) { return square > small * small; }));
  if (8 * count > 7 * k || count >= all) {
    DenseMatrix diagonal(all * all);
    for (std::size_t j = 0; j < all; ++j) diagonal[j * all + j] = factors[j];
    return diagonal;
  }
  DenseMatrix combinations(all * count);
  for (std::size_t c = 0; c < count; ++c) {
    const double *direction = gram.data() + (k - 1 - c) * k, size = std::sqrt(squares[k - 1 - c]);
    for (std::size_t j = 0; j < all; ++j)
      combinations[c * all + j] =
          factors[j] / size *
          std::inner_product(direction, direction + k, sketch.data() + j * k, 0.0);
  }
  return combinations;
}

}  // namespace squeal::linalg
