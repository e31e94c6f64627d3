// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Condition numbers of eigenvalues from left eigenvectors.
#include <vector>

#include "algebra/linalg/quadratic.hpp"

namespace squeal::reduction {

/// Returns for each pair, which must have its left vector, the number κ in [M.36]
///   |δs|/|s| ≤ κ ‖e‖ ‖r‖,   κ = 1 / |s yᴴ P′(s) d|,   P′ = 2 s M + Z.
/// This holds to first order for a residual r = P(s) d of the full problem and an error e of the
/// left vector in energy. It follows from δs = −yᴴ r / (yᴴ P′(s) d): where Vᵀ r = 0, only the part
/// e of y outside of the basis counts. Eigenvalues within 1e-6 |s| of each other are treated as a
/// group, since the vectors of a multiple eigenvalue are arbitrary. For a group of p, κ is p / |s|
/// divided by the smallest singular value of the matrix of all yᴴ P′ d [M.38]. The number is
/// infinite for a defective eigenvalue. An eigenvalue smaller than `least`, rad/s, is treated as
/// one of that size, and its errors are relative to `least`: s = 0 has no relative error, and is
/// defective in a problem in s². Not collective; `problem` is the projection on the basis. The
/// vectors are in its coordinates.
std::vector<double> conditionNumbers(const linalg::DenseProblem& problem,
                                     const std::vector<linalg::DensePair>& pairs, double least = 0);

}  // namespace squeal::reduction
