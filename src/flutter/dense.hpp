#pragma once
/// Small dense quadratic eigenproblems (s² M + s Z + K) q = 0, real unsymmetric matrices, by LAPACK. Not collective.
#include <complex>
#include <vector>

namespace squeal::flutter {

/// Column-major m×m.
using DenseMatrix = std::vector<double>;

struct DensePair {
  std::complex<double> s;
  std::vector<std::complex<double>> q;  ///< [m], 2-norm 1
};

/// All eigenvalues with Im s ≥ 0, by ascending Im s, then Re s. An empty Z: the problem is linear in s², solved at size m;
/// otherwise its companion form of size 2m is scaled and solved. Error: LAPACK fails, or M is singular (an eigenvalue is
/// infinite).
std::vector<DensePair> solveQuadratic(const DenseMatrix& mass, const DenseMatrix& damping, const DenseMatrix& stiffness, int m);

}  // namespace squeal::flutter
