// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Schur complements of sparse symmetric matrices.
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "base/petsc/owned.hpp"

namespace squeal::factor {

/// Collective. Returns the Schur complement
///   S = K_ww − K_wy K_yy⁻¹ K_yw
/// of a symmetric matrix with a definite K_yy. The unknowns w remain, and the unknowns y are
/// eliminated. `own` lists the global rows of w on this rank, in any order. The result contains
/// these rows and the columns of all w, ordered by rank and, within each rank, as in its `own`.
/// The matrix is freed before the factorisation, of which MUMPS has its own copy; the caller may
/// share it. Rank 0 temporarily stores all of S, 8 bytes for each pair of unknowns w. Throws Error,
/// on all ranks, if the factorisation fails.
linalg::DenseMatrix schurComplement(OwnedMat matrix, const std::vector<PetscInt>& own);

}  // namespace squeal::factor
