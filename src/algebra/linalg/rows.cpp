// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/linalg/rows.hpp"

namespace squeal::linalg {

DenseMatrix rowsOf(const std::vector<PetscInt>& rows, const DenseView& matrix) {
  DenseMatrix part(std::ssize(rows), matrix.columns());
  for (PetscInt j = 0; j < part.columns(); ++j)
    for (PetscInt i = 0; i < part.rows(); ++i) part(i, j) = matrix(rows[i], j);
  return part;
}

DenseMatrix principalPart(const std::vector<PetscInt>& rows, const DenseView& matrix) {
  const PetscInt size = std::ssize(rows);
  DenseMatrix part(size, size);
  for (PetscInt j = 0; j < size; ++j)
    for (PetscInt i = 0; i < size; ++i) part(i, j) = matrix(rows[i], rows[j]);
  return part;
}

DenseMatrix gatheredRows(const Concatenation& ranks, const DenseView& own) {
  const DenseMatrix rows = transposed(own);  // by rows: all of them in one message
  DenseMatrix all(own.columns(), ranks.size());
  ranks.gather(rows.data(), all.data(), static_cast<int>(own.columns()));
  return transposed(all);
}

}  // namespace squeal::linalg
