// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Null vectors of a dense quadratic problem. Not collective.
#include <vector>

#include "algebra/linalg/complex.hpp"
#include "algebra/linalg/quadratic.hpp"

namespace squeal::linalg {

/// A right and a left null vector of H(s), of 2-norm 1.
struct NullVectors {
  std::vector<Complex> right;  ///< q, H(s) q = 0
  std::vector<Complex> left;   ///< c, cᴴ H(s) = 0
};

/// Returns the null vectors of H(s) = s² M + s Z + K at an eigenvalue s, by inverse iteration. They
/// are the singular vectors of the smallest singular value, so they are well defined even where two
/// eigenvalues and their vectors meet. With `simple`, s must be a simple eigenvalue but need not be
/// exact to the last digits: the two-sided Rayleigh quotient corrects it by
///   δs = −cᴴ H q / cᴴ H′ q.
NullVectors nullVectors(const DenseProblem& problem, Complex s, bool simple);

}  // namespace squeal::linalg
