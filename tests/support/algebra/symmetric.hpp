// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Small symmetric matrices.
#include <gtest/gtest.h>
#include <petscsys.h>  // before the next header, which needs it

#include <petscblaslapack.h>

#include <cmath>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "support/algebra/dense.hpp"

namespace squeal::test {

/// Ascending.
inline std::vector<double> symmetricEigenvalues(linalg::DenseMatrix matrix) {
  PetscBLASInt n = matrix.rows(), length = 40 * n, info = 0;
  std::vector<double> eigenvalues(n), work(length);
  LAPACKsyev_("N", "U", &n, matrix.data(), &n, eigenvalues.data(), work.data(), &length, &info);
  EXPECT_EQ(info, 0);
  return eigenvalues;
}

/// The largest difference from the transposed matrix, relative to the largest entry.
inline double asymmetry(const linalg::DenseMatrix& matrix) {
  double difference = 0;
  for (PetscInt i = 0; i < matrix.rows(); ++i)
    for (PetscInt j = 0; j < matrix.columns(); ++j)
      difference = worse(difference, std::abs(matrix(i, j) - matrix(j, i)));
  return difference / largestEntry(matrix);
}

}  // namespace squeal::test
