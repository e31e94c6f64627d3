// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Products of small dense matrices with vectors, by BLAS. Not collective.
#include <petscblaslapack.h>

#include <vector>

#include "algebra/linalg/dense.hpp"

namespace squeal::march {

/// Computes y += factor · A x, or factor · Aᵀ x if `transposed`.
inline void addProduct(const linalg::DenseView& a, const std::vector<double>& x,
                       std::vector<double>& y, double factor = 1, bool transposed = false) {
  if (a.empty()) return;
  const PetscBLASInt rows = a.rows(), columns = a.columns(), one = 1;
  const double unit = 1;
  BLASgemv_(transposed ? "T" : "N", &rows, &columns, &factor, a.data(), &rows, x.data(), &one,
            &unit, y.data(), &one);
}

inline double dot(const std::vector<double>& x, const std::vector<double>& y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

}  // namespace squeal::march
