// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Determinant and principal minors of small dense matrices.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "algebra/linalg/dense.hpp"

namespace squeal::test {

/// Product of the pivots of Gaussian elimination with row pivoting.
inline double determinant(linalg::DenseMatrix a) {
  const PetscInt n = a.rows();
  double result = 1;
  for (PetscInt k = 0; k < n; ++k) {
    PetscInt pivot = k;
    for (PetscInt i = k + 1; i < n; ++i)
      if (std::abs(a(i, k)) > std::abs(a(pivot, k))) pivot = i;
    if (a(pivot, k) == 0) return 0;
    if (pivot != k) result = -result;
    for (PetscInt j = k; j < n; ++j) std::swap(a(k, j), a(pivot, j));
    result *= a(k, k);
    for (PetscInt i = k + 1; i < n; ++i) {
      const double factor = a(i, k) / a(k, k);
      for (PetscInt j = k; j < n; ++j) a(i, j) -= factor * a(k, j);
    }
  }
  return result;
}

/// The smallest of all principal minors.
inline double smallestMinor(const linalg::DenseMatrix& a) {
  double smallest = INFINITY;
  for (unsigned set = 1; set < 1U << a.rows(); ++set) {
    std::vector<PetscInt> kept;
    for (PetscInt i = 0; i < a.rows(); ++i)
      if (set >> i & 1U) kept.push_back(i);
    const PetscInt size = std::ssize(kept);
    linalg::DenseMatrix part(size, size);
    for (PetscInt j = 0; j < size; ++j)
      for (PetscInt i = 0; i < size; ++i) part(i, j) = a(kept[i], kept[j]);
    smallest = std::min(smallest, determinant(part));
  }
  return smallest;
}

}  // namespace squeal::test
