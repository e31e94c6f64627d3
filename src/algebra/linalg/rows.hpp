// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Selected rows of dense matrices, and all rows of a matrix whose rows are distributed.
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "base/system/concatenation.hpp"

namespace squeal::linalg {

/// Not collective. Returns these rows of a matrix.
DenseMatrix rowsOf(const std::vector<PetscInt>& rows, const DenseView& matrix);
/// Not collective. Returns the entries in these rows and columns of a square matrix.
DenseMatrix principalPart(const std::vector<PetscInt>& rows, const DenseView& matrix);
/// Collective. Returns the rows of all ranks on every rank. `own` contains the rows of this rank.
DenseMatrix gatheredRows(const Concatenation& ranks, const DenseView& own);

}  // namespace squeal::linalg
