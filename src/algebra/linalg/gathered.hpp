// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Copies of small distributed matrices on rank 0.
#include "algebra/linalg/dense.hpp"
#include "base/petsc/owned.hpp"

namespace squeal::linalg {

/// Collective. Returns a sequential copy of the whole matrix on rank 0, and a matrix without rows
/// on the other ranks.
OwnedMat onRankZero(Mat matrix);

/// Collective. Returns the whole square matrix on rank 0, and an empty matrix on the other ranks.
/// For a null matrix, the result is empty on all ranks.
DenseMatrix gathered(Mat matrix);

}  // namespace squeal::linalg
