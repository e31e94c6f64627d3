// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Improvement of known eigenpairs of dense quadratic problems after their basis has grown. For
/// some tens among some hundreds of eigenvalues, this takes a fraction of the time of a full solve.
#include <mpi.h>

#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "eigen/reduction/pair_group.hpp"

namespace squeal::reduction {

/// Pairs of one problem, all with right and left vectors; vectors of a smaller basis are extended
/// by zeros. Pairs that are not in `open` do not change, but serve as neighbours.
struct CorrectionTask {
  const linalg::DenseProblem* problem;
  std::vector<linalg::DensePair>* pairs;
  std::vector<UnconvergedPair> open;
};

/// Collective. All ranks must pass the same problems and pairs. Improves the pairs in `open` in
/// groups of neighbours, by two-sided block inverse iteration on the right and left eigenvectors of
/// a group: with a shift σ in the middle of the group, the operator
///   (A − σB)⁻¹ B,   A = [0 I; −K −Z],   B = [I 0; 0 M],
/// is projected on three sets of vectors: those of the group, those of its neighbours, and the
/// operator times those of the group. The groups of all problems are distributed over the ranks,
/// and all ranks get the same pairs. For each task, returns false if this fails or if two pairs
/// have become one; its pairs are then in an undefined state. Throws Error on all ranks if LAPACK
/// fails.
std::vector<bool> correctPairs(MPI_Comm comm, const std::vector<CorrectionTask>& tasks);

}  // namespace squeal::reduction
