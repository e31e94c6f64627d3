// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Lengths of the columns and rows of matrices that consist of parts. Each part is a separate
/// majorant (kept.hpp), so the lengths in the parts are added. Not collective.
#include <span>
#include <vector>

#include "algebra/linalg/complexdense.hpp"

namespace squeal::proof {

/// Returns for each column the sum of its 2-norms in the parts, which end before these rows; zeros
/// for an empty matrix.
std::vector<double> columnLengths(const linalg::ComplexMatrix& a,
                                  std::span<const PetscInt> rowEnds);
/// Returns the same for each row, with parts that end before these columns.
std::vector<double> rowLengths(const linalg::ComplexMatrix& a,
                               std::span<const PetscInt> columnEnds);

}  // namespace squeal::proof
