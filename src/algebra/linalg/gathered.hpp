// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// These functions copy small distributed matrices to rank 0.
#include "algebra/linalg/dense.hpp"
#include "base/petsc/owned.hpp"

namespace squeal::linalg {

/// Collective. Returns a sequential copy of the whole matrix on rank 0, and a matrix without rows
/// on the other ranks.
OwnedMat onRankZero(Mat matrix);

/// Collective. Returns the whole of a square matrix on rank 0, and a matrix without rows and
/// columns on the other ranks. A null matrix has no rows on any rank.
DenseMatrix gathered(Mat matrix);

}  // namespace squeal::linalg
