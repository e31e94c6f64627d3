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
/// ascending, for a symmetric A and a symmetric positive definite B. Reads only the lower
/// triangles. Replaces A by B-orthonormal eigenvectors, and B by its Cholesky factor. Throws Error
/// as above, and if B is not positive definite.
std::vector<double> symmetricEigen(DenseMatrix& a, DenseMatrix& b);

/// Returns the lower triangular L of A = L Lᵀ for a symmetric positive definite A. Reads only the
/// lower triangle of A. Throws Error if A is not positive definite.
DenseMatrix choleskyFactor(DenseMatrix a);
/// Returns L⁻ᵀ for a lower triangular L.
DenseMatrix inverseTransposed(const DenseMatrix& factor);

/// Returns the number of negative eigenvalues of a matrix that is symmetric within round-off, by an
/// LDLᵀ factorisation. Throws Error if LAPACK fails.
int negativeEigenvalues(const DenseView& a);

/// Return the same eigenvalues as symmetricEigen() without eigenvectors, which takes a fraction of
/// the time. They also read only the lower triangles.
std::vector<double> symmetricEigenvalues(DenseMatrix a);
std::vector<double> symmetricEigenvalues(DenseMatrix a, DenseMatrix b);

}  // namespace squeal::linalg
