// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Small matrices of known and of random entries.
#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "support/harness/largest_error.hpp"

namespace squeal::test {

/// Returns the square matrix with these entries, column by column.
inline linalg::DenseMatrix square(std::vector<double> columns) {
  const PetscInt n = std::lround(std::sqrt(columns.size()));
  return {n, n, std::move(columns)};
}

/// Returns the diagonal matrix with these entries.
inline linalg::DenseMatrix diagonal(std::span<const double> entries) {
  const PetscInt n = std::ssize(entries);
  linalg::DenseMatrix matrix(n, n);
  for (PetscInt i = 0; i < n; ++i) matrix(i, i) = entries[i];
  return matrix;
}

inline linalg::DenseMatrix identity(PetscInt n) { return diagonal(std::vector<double>(n, 1.0)); }

/// Returns a pseudo-random number between −1 and 1.
inline double uniform(std::mt19937& generator) { return 2.0 * generator() / 4294967295.0 - 1; }

/// Returns a matrix with pseudo-random entries between −1 and 1, and with `diagonal` added to those
/// of its diagonal. It does not depend on the rank.
inline linalg::DenseMatrix randomMatrix(PetscInt rows, PetscInt columns, std::mt19937& generator,
                                        double diagonal = 0) {
  linalg::DenseMatrix matrix(rows, columns);
  for (double& entry : matrix.entries()) entry = uniform(generator);
  for (PetscInt i = 0; i < std::min(rows, columns); ++i) matrix(i, i) += diagonal;
  return matrix;
}

/// Returns the largest magnitude of the entries, or NaN if one of them is NaN.
inline double largestEntry(const linalg::DenseView& matrix) {
  double result = 0;
  for (const double entry : matrix.entries()) result = worse(result, std::abs(entry));
  return result;
}

/// Returns the largest magnitude of the entries of A − B, or NaN, which fails any comparison, if
/// their sizes differ.
inline double largestDifference(linalg::DenseMatrix a, const linalg::DenseView& b) {
  if (a.rows() != b.rows() || a.columns() != b.columns()) return NAN;
  linalg::addScaled(a, -1, b);
  return largestEntry(a);
}

}  // namespace squeal::test
