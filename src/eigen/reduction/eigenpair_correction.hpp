// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Improvement of known eigenpairs of dense quadratic problems after their basis has grown. For
/// some tens out of some hundreds of eigenvalues, this takes a fraction of the time of a full
/// solve.
#include <mpi.h>

#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "eigen/reduction/pair_group.hpp"

namespace squeal::reduction {

/// Pairs of one problem, all with both vectors; vectors of a smaller basis are extended by zeros.
/// Pairs that are not open serve as neighbours and do not change.
struct CorrectionTask {
  const linalg::DenseProblem* problem;
  std::vector<linalg::DensePair>* pairs;
  std::vector<UnconvergedPair> open;
};

/// Collective. All ranks have the same problems and pairs. Improves the open pairs in groups of
/// neighbours, whose right and left eigenvectors iterate together (two-sided block inverse
/// iteration): with a shift σ amid a group, the operator
///   (A − σB)⁻¹ B,   A = [0 I; −K −Z],   B = [I 0; 0 M],
/// is projected on the vectors of the group, the vectors of its neighbours, and the operator times
/// the former. The groups of all problems are distributed over the ranks, and all ranks get the
/// same pairs. Returns for each task false if this fails or if two pairs have become one; the pairs
/// of this task are then in an undefined state. Throws Error on all ranks if LAPACK fails.
std::vector<bool> correctPairs(MPI_Comm comm, const std::vector<CorrectionTask>& tasks);

}  // namespace squeal::reduction
