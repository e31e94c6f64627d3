// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Improvement of known eigenpairs of dense quadratic problems after their basis has grown. If
/// only a few tens out of several hundred eigenvalues are needed, this is much faster than a full
/// solve.
#include <mpi.h>

#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "eigen/reduction/pair_group.hpp"

namespace squeal::reduction {

/// Pairs of one problem, all with right and left vectors. Vectors of a smaller basis are padded
/// with zeros. Pairs that are not in `open` do not change, but serve as neighbours.
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
/// and all ranks get the same pairs. For each task, returns false if the iteration fails or if two
/// pairs converge to the same one; the pairs of the task are then in an undefined state. Throws
/// Error on all ranks if LAPACK fails or if the vectors are too long for one message.
std::vector<bool> correctPairs(MPI_Comm comm, const std::vector<CorrectionTask>& tasks);

}  // namespace squeal::reduction
