// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/proof/lengths.hpp"

#include <algorithm>
#include <cmath>

namespace squeal::proof {

std::vector<double> columnLengths(const linalg::ComplexMatrix& a,
                                  std::span<const PetscInt> rowEnds) {
  std::vector<double> lengths(a.columns());
  for (PetscInt j = 0; j < a.columns(); ++j) {
    PetscInt i = 0;
    for (const PetscInt end : rowEnds) {
      double squares = 0;
      for (; i < end; ++i) squares += std::norm(a(i, j));
      lengths[j] += std::sqrt(squares);
    }
  }
  return lengths;
}

std::vector<double> rowLengths(const linalg::ComplexMatrix& a,
                               std::span<const PetscInt> columnEnds) {
  std::vector<double> lengths(a.rows()), squares(a.rows());
  PetscInt j = 0;
  for (const PetscInt end : columnEnds) {
    std::ranges::fill(squares, 0.0);
    for (; j < end; ++j)
      for (PetscInt i = 0; i < a.rows(); ++i) squares[i] += std::norm(a(i, j));
    for (PetscInt i = 0; i < a.rows(); ++i) lengths[i] += std::sqrt(squares[i]);
  }
  return lengths;
}

}  // namespace squeal::proof
