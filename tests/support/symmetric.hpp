#pragma once
/// Symmetric matrices as plain arrays.
#include <gtest/gtest.h>
#include <petscsys.h>  // before the next header, which needs it

#include <petscblaslapack.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/model.hpp"

namespace squeal::test {

/// Ascending.
inline std::vector<double> symmetricEigenvalues(DenseCopy matrix) {
  PetscBLASInt n = matrix.rows, length = 40 * n, info = 0;
  std::vector<double> eigenvalues(static_cast<std::size_t>(n)),
      work(static_cast<std::size_t>(length));
  LAPACKsyev_("N", "U", &n, matrix.values.data(), &n, eigenvalues.data(), work.data(), &length,
              &info);
  EXPECT_EQ(info, 0);
  return eigenvalues;
}

/// The largest difference from the transposed matrix, relative to the largest entry.
inline double asymmetry(const DenseCopy& matrix) {
  double worst = 0, largest = 0;
  for (PetscInt i = 0; i < matrix.rows; ++i)
    for (PetscInt j = 0; j < matrix.columns; ++j) {
      worst = std::max(worst, std::abs(matrix(i, j) - matrix(j, i)));
      largest = std::max(largest, std::abs(matrix(i, j)));
    }
  return worst / largest;
}

}  // namespace squeal::test
