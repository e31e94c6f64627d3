// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Blocks of columns of nodal displacements.
#include <mpi.h>

#include <span>

#include "algebra/linalg/block.hpp"
#include "base/petsc/check.hpp"
#include "base/petsc/owned.hpp"

namespace squeal::regime {

/// The number of columns whose products are in memory at the same time.
inline constexpr PetscInt blockColumns = 64;

/// Collective. Returns a vector that borrows the entries of one column.
inline OwnedVec borrowedVector(MPI_Comm comm, std::span<const double> column) {
  OwnedVec vector;
  check(
      VecCreateMPIWithArray(comm, 1, column.size(), PETSC_DETERMINE, column.data(), vector.out()));
  return vector;
}

/// Collective. Returns A X; zeros if A is null.
inline linalg::Block productOf(Mat a, const linalg::DenseView& x) {
  if (!a) return linalg::Block(x.rows(), x.columns());
  linalg::Block result(x.rows());
  linalg::appendProduct(a, x, result);
  return result;
}

}  // namespace squeal::regime
