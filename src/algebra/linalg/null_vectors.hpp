// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Null vectors of a dense quadratic problem. Not collective.
#include <vector>

#include "algebra/linalg/complex.hpp"
#include "algebra/linalg/quadratic.hpp"

namespace squeal::linalg {

/// Vectors of 2-norm 1.
struct NullVectors {
  std::vector<Complex> right;  ///< q, H(s) q = 0
  std::vector<Complex> left;   ///< c, cᴴ H(s) = 0
};

/// Returns the null vectors of H(s) = s² M + s Z + K at an eigenvalue s: those of the smallest
/// singular value, by inverse iteration, so that they are well defined where two eigenvalues and
/// their vectors meet. If s is `simple`, it may have only a few exact digits, and the two-sided
/// Rayleigh quotient corrects it:
///   δs = −cᴴ H q / cᴴ H′ q.
NullVectors nullVectors(const DenseProblem& problem, Complex s, bool simple);

}  // namespace squeal::linalg
