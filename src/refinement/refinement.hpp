#pragma once
/// Known eigenpairs of a dense quadratic problem are made better after its basis has grown, and it
/// is checked that no eigenvalue has been missed. For some tens of eigenvalues of some hundred,
/// this takes a small part of the time of finding all of them. Not collective.
#include <optional>
#include <vector>

#include "linalg/quadratic.hpp"

namespace squeal::refinement {

/// A pair of a list that is to be improved.
struct Open {
  std::size_t pair;
  double left;  ///< the part of the length of its residual P(s) x that may be left
};

/// Improves the open pairs of a list in groups of neighbours, whose right and left eigenvectors
/// iterate together (two-sided block inverse iteration): with a shift σ amid a group, the operator
///   (A − σB)⁻¹ B,   A = [0 I; −K −Z],   B = [I 0; 0 M],
/// is projected on the vectors of the group, those of its neighbours, and the operator times the
/// first. All pairs have both vectors; those of a smaller basis are extended by zeros. The pairs
/// that are not open serve as neighbours and stay as they are. The residuals of left vectors become
/// a tenth of what they were. Returns false, with the list in any state, if that fails, or if two
/// pairs have become one. Throws Error if LAPACK fails.
bool improve(const linalg::DenseProblem& problem, std::vector<linalg::DensePair>& pairs,
             const std::vector<Open>& open);

/// Looks for an eigenvalue that is wanted and not among these pairs, which have both vectors: where
/// the known eigenvalues and their conjugates are deflated, the Arnoldi method on the same operator
/// finds the unknown ones nearest to each shift σ. Returns the first that it finds. A starting
/// vector of random entries has part in all eigenvectors, with probability one. Throws Error if
/// LAPACK fails.
std::optional<Complex> missing(const linalg::DenseProblem& problem,
                               const std::vector<linalg::DensePair>& pairs,
                               const std::vector<Complex>& shifts, const linalg::Wanted& wanted);

}  // namespace squeal::refinement
