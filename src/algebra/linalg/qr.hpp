// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The QR factorisation of small dense matrices, by LAPACK. Not collective.
#include "algebra/linalg/dense.hpp"

namespace squeal::linalg {

/// The factorisation A = Q [R; 0] of a matrix with at most as many columns as rows. Q is square and
/// orthogonal.
class Qr {
 public:
  /// Factorises A, m × n with m ≥ n. Throws Error if LAPACK fails.
  explicit Qr(const DenseView& a);
  const DenseMatrix& q() const { return q_; }  ///< m × m
  /// Replaces B, with n columns, by B R⁻¹. R must be nonsingular.
  void divideByR(DenseMatrix& b) const;

 private:
  DenseMatrix q_, r_;  // R in the upper triangle
};

/// Replaces the columns of X by orthonormal columns, whose span contains that of the old ones
/// (Householder). X must have at most as many columns as rows. Throws Error if LAPACK fails.
void orthonormalise(DenseMatrix& x);

/// Returns the upper triangular factor R, min(m, n) × n, of A = Q R, where Q has orthonormal
/// columns. Throws Error if LAPACK fails.
DenseMatrix triangularFactor(DenseMatrix a);

}  // namespace squeal::linalg
