#pragma once
/// Small distributed matrices brought to rank 0.
#include <vector>

#include "petsc/owned.hpp"

namespace squeal::linalg {

/// Collective. The whole matrix as a sequential one on rank 0, of no rows elsewhere.
OwnedMat onRankZero(Mat matrix);

/// Collective. All entries of a square matrix on rank 0, column-major; empty elsewhere and for a
/// matrix that is not there.
std::vector<double> gathered(Mat matrix);

}  // namespace squeal::linalg
