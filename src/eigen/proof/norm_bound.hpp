// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Upper bounds of the 2-norm of dense matrices. Not collective.
#include "algebra/linalg/dense.hpp"

namespace squeal::proof {

/// Returns the smaller of the Frobenius norm and √(‖A‖₁ ‖A‖_∞), both of which bound the 2-norm.
double quickBound(const linalg::ComplexMatrix& a);
double quickBound(const linalg::DenseView& a);

/// Returns a bound of the 2-norm, in general less than 1 % above it and at most quickBound(). The
/// Lanczos method only proposes a bound c. The bound is accepted only if the Cholesky factorisation
/// of c² − AᴴA succeeds.
double normBound(const linalg::ComplexMatrix& a);

}  // namespace squeal::proof
