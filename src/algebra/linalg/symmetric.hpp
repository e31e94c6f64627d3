// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Small dense symmetric eigenproblems, solved by LAPACK. Not collective.
#include <vector>

#include "algebra/linalg/dense.hpp"

namespace squeal::linalg {

/// Returns (A + Aᵀ)/2.
DenseMatrix symmetricPart(const DenseView& a);

/// Returns the eigenvalues of a symmetric matrix, ascending. Reads only the lower triangle of A and
/// replaces A by orthonormal eigenvectors, as columns. Throws Error if LAPACK fails or an
/// eigenvalue is not finite.
std::vector<double> symmetricEigen(DenseMatrix& a);

/// Returns the eigenvalues λ of
///   A x = λ B x,
/// ascending, for A symmetric and B symmetric positive definite, both stored as above.
/// B-orthonormal eigenvectors replace A, and a Cholesky factor replaces B. Throws Error as above,
/// and if B is not positive definite.
std::vector<double> symmetricEigen(DenseMatrix& a, DenseMatrix& b);

/// Returns L of A = L Lᵀ, lower triangular, for a symmetric positive definite A. Reads only its
/// lower triangle. Throws Error if A is not positive definite.
DenseMatrix choleskyFactor(DenseMatrix a);
/// Returns L⁻ᵀ.
DenseMatrix inverseTransposed(const DenseMatrix& factor);

/// Returns the number of negative eigenvalues of a matrix that is symmetric within round-off, by an
/// LDLᵀ factorisation. Throws Error if LAPACK fails.
int negativeEigenvalues(const DenseView& a);

/// Return only the eigenvalues of the same problems, which takes a fraction of the time. They read
/// the lower triangles.
std::vector<double> symmetricEigenvalues(DenseMatrix a);
std::vector<double> symmetricEigenvalues(DenseMatrix a, DenseMatrix b);

}  // namespace squeal::linalg
