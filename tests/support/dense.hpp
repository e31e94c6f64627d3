#pragma once
/// Small matrices of known entries.
#include <cmath>
#include <vector>

#include "linalg/dense.hpp"

namespace squeal::test {

/// Returns the square matrix with these entries, column by column.
inline linalg::DenseMatrix square(std::vector<double> columns) {
  const PetscInt n = std::lround(std::sqrt(columns.size()));
  return {n, n, std::move(columns)};
}

}  // namespace squeal::test
