// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Properties of matrices.
#include "base/petsc/owned.hpp"

namespace squeal {

/// Not collective. Returns true if the matrix is marked as symmetric.
bool isSymmetric(Mat matrix);
/// Not collective. Returns true if the matrix is stored as a sparse one.
bool isSparse(Mat matrix);
/// Collective. Returns the index set of this rank's rows of a matrix.
OwnedIS ownRows(Mat matrix);

}  // namespace squeal
