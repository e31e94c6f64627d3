// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Small symmetric matrices.
#include <cmath>

#include "algebra/linalg/dense.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "support/algebra/dense.hpp"

namespace squeal::test {

/// The largest difference from the transposed matrix, relative to the largest entry.
inline double asymmetry(const linalg::DenseMatrix& matrix) {
  double difference = 0;
  for (PetscInt i = 0; i < matrix.rows(); ++i)
    for (PetscInt j = 0; j < matrix.columns(); ++j)
      difference = worse(difference, std::abs(matrix(i, j) - matrix(j, i)));
  return difference / largestEntry(matrix);
}

}  // namespace squeal::test
