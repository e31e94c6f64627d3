#pragma once
/// How far residuals move eigenvalues: condition numbers by left eigenvectors.
#include <vector>

#include "linalg/quadratic.hpp"

namespace squeal::reduction {

/// For each pair (with left vectors) the number κ of |δs|/|s| ≤ κ ‖e‖ ‖r‖, to first order, for a
/// residual r = P(s) d of the full problem and an error e of the left vector in energy: δs = −yᴴr /
/// (yᴴP'(s)d), P' = 2sM + Z, and where Vᵀr = 0 only the part e of y outside of the basis counts. So
/// κ = 1 / |s yᴴP'd|. Eigenvalues within 1e-6 of each other are taken as one cluster with one
/// number, for p of them p over the smallest singular value of all yᴴP'd: any vectors may stand for
/// a multiple eigenvalue. Infinite for a defective one.
std::vector<double> conditionNumbers(const linalg::DenseProblem& problem,
                                     const std::vector<linalg::DensePair>& pairs);

}  // namespace squeal::reduction
