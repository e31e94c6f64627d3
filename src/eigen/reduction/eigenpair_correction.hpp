#pragma once
/// Known eigenpairs of dense quadratic problems are made better after their basis has grown, and it
/// is checked that no eigenvalue has been missed. For some tens of eigenvalues of some hundred,
/// this takes a small part of the time of finding all of them.
#include <mpi.h>

#include <optional>
#include <vector>

#include "algebra/linalg/quadratic.hpp"

namespace squeal::reduction {

/// A pair of a list that is to be improved.
struct UnconvergedPair {
  std::size_t pair;
  double right;  ///< the part of the length of its residual P(s) x that may remain
  double left;   ///< that of P(s)ᴴ y
};

/// Pairs of one problem, all with both vectors; those of a smaller basis are extended by zeros. The
/// pairs that are not open serve as neighbours and stay as they are.
struct CorrectionTask {
  const linalg::DenseProblem* problem;
  std::vector<linalg::DensePair>* pairs;
  std::vector<UnconvergedPair> open;
};

/// Collective; all ranks have the same problems and pairs. Improves the open pairs in groups of
/// neighbours, whose right and left eigenvectors iterate together (two-sided block inverse
/// iteration): with a shift σ amid a group, the operator
///   (A − σB)⁻¹ B,   A = [0 I; −K −Z],   B = [I 0; 0 M],
/// is projected on the vectors of the group, those of its neighbours, and the operator times the
/// first. The groups of all problems are spread over the ranks, and all ranks get the same pairs.
/// Returns false, [task], with the pairs in any state, if that fails, or if two pairs have become
/// one. Throws Error on all ranks if LAPACK fails.
std::vector<bool> correctPairs(MPI_Comm comm, const std::vector<CorrectionTask>& tasks);

/// Not collective. Looks for an eigenvalue that is wanted and not among these pairs, which have
/// both vectors: where the known eigenvalues and their conjugates are deflated, the Arnoldi method
/// on the same operator finds the unknown ones nearest to the shift σ. A starting vector of random
/// entries has part in all eigenvectors, with probability one. Throws Error if LAPACK fails.
std::optional<Complex> findMissing(const linalg::DenseProblem& problem,
                                   const std::vector<linalg::DensePair>& pairs, Complex shift,
                                   const linalg::Wanted& wanted);

}  // namespace squeal::reduction
