// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Condition numbers of eigenvalues from left eigenvectors.
#include <vector>

#include "algebra/linalg/quadratic.hpp"

namespace squeal::reduction {

/// Returns κ of [M.36] for each pair, which must have its left vector:
///   |δs|/|s| ≤ κ ‖e‖ ‖r‖,   κ = 1 / |s yᴴ P′(s) d|,   P′ = 2 s M + Z.
/// The bound holds to first order for the residual r = P(s) d of the full problem, in the norm of
/// K0⁻¹, and the error e of the left vector y, in the norm of K0. It follows from
///   δs = −yᴴ r / (yᴴ P′(s) d):
/// since Vᵀ r = 0 for the basis V, only e, the part of y outside the basis, contributes.
///
/// Eigenvalues within 1e-6 |s| of each other are treated as a group, since the vectors of a
/// multiple eigenvalue are arbitrary. For a group of p eigenvalues, κ is p / |s| divided by the
/// smallest singular value of the matrix of all yᴴ P′ d [M.38]. κ is infinite for a defective
/// eigenvalue. If |s| is below `least`, rad/s, s is scaled to that magnitude, and its error is
/// relative to `least`: s = 0 has no relative error, and is defective in a problem in s². `problem`
/// is the projection on the basis, and the vectors are in coordinates of the basis. Not collective.
std::vector<double> conditionNumbers(const linalg::DenseProblem& problem,
                                     const std::vector<linalg::DensePair>& pairs, double least = 0);

}  // namespace squeal::reduction
