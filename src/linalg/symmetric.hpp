#pragma once
/// Small dense symmetric eigenproblems, by LAPACK. Not collective.
#include <vector>

namespace squeal::linalg {

/// Eigenvalues of a symmetric matrix (n×n, its lower triangle column-major), ascending; orthonormal
/// eigenvectors take its place as columns. Error: LAPACK fails.
std::vector<double> symmetricEigen(std::vector<double>& a, int n);

/// Eigenvalues of A x = λ B x, A symmetric, B symmetric positive definite (both as above),
/// ascending; B-orthonormal eigenvectors take the place of A, a Cholesky factor that of B. Error:
/// LAPACK fails, B is not positive definite.
std::vector<double> symmetricEigen(std::vector<double>& a, std::vector<double>& b, int n);

}  // namespace squeal::linalg
