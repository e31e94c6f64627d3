// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Unsymmetric dense eigenproblems, linear in the eigenvalue, solved by LAPACK. Not collective.
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "algebra/linalg/quadratic.hpp"

namespace squeal::linalg {

/// An eigenvalue with its vectors.
struct EigenPair {
  Complex value;
  std::vector<Complex> right;
  std::vector<Complex> left;  ///< empty unless requested
};

/// Returns the finite eigenvalues of A x = μ B x that `wanted` selects, with eigenvectors, by QZ.
/// Throws Error if A and B have a common null vector, or if LAPACK fails.
std::vector<EigenPair> generalized(DenseMatrix a, DenseMatrix b, Vectors sides,
                                   const EigenvalueFilter& wanted);
/// Returns the eigenvalues of A x = μ x that `wanted` selects, with eigenvectors, from the Schur
/// form of A. It computes only these eigenvectors, since computing all of them would take most of
/// the time. Throws Error if LAPACK fails.
std::vector<EigenPair> standard(DenseMatrix a, Vectors sides, const EigenvalueFilter& wanted);

/// Returns the conjugate of a vector.
std::vector<Complex> conjugated(std::vector<Complex> vector);

}  // namespace squeal::linalg
