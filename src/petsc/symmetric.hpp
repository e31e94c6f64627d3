#pragma once
/// Small dense symmetric eigenproblems, by LAPACK. Not collective.
#include <vector>

namespace squeal {

/// Eigenvalues of a symmetric matrix (n×n, its lower triangle column-major), ascending; orthonormal eigenvectors take its place as
/// columns. Error: LAPACK fails.
std::vector<double> symmetricEigen(std::vector<double>& a, int n);

}  // namespace squeal
