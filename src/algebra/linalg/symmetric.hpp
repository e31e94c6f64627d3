// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// These functions solve small dense symmetric eigenproblems by LAPACK. Not collective.
#include <vector>

#include "algebra/linalg/dense.hpp"

namespace squeal::linalg {

/// Returns (A + Aᵀ)/2.
DenseMatrix symmetricPart(const DenseView& a);

/// Returns the eigenvalues of a symmetric matrix, ascending. Only the lower triangle of A is read.
/// Orthonormal eigenvectors replace it, as columns. Throws Error if LAPACK fails or an eigenvalue
/// is not a finite number, as with entries that are not.
std::vector<double> symmetricEigen(DenseMatrix& a);

/// Returns the eigenvalues λ of
///   A x = λ B x,
/// ascending, for A symmetric and B symmetric positive definite, both stored as above.
/// B-orthonormal eigenvectors replace A, and a Cholesky factor replaces B. Throws Error as above,
/// and if B is not positive definite.
std::vector<double> symmetricEigen(DenseMatrix& a, DenseMatrix& b);

}  // namespace squeal::linalg
