#pragma once
/// Copies of small distributed matrices on rank 0.
#include <vector>

#include "petsc/owned.hpp"

namespace squeal::linalg {

/// Collective. Returns a sequential copy of the whole matrix on rank 0, and a matrix without rows
/// on the other ranks.
OwnedMat onRankZero(Mat matrix);

/// Collective. Returns all entries of a square matrix on rank 0, column-major. The result is empty
/// on the other ranks, and on all ranks for a null matrix.
std::vector<double> gathered(Mat matrix);

}  // namespace squeal::linalg
