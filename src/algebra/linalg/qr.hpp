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
  /// Replaces B, with n columns, by B R⁻¹. R must be regular.
  void divideByR(DenseMatrix& b) const;

 private:
  DenseMatrix q_, r_;  // R in the upper triangle
};

/// Replaces the columns, at most as many as rows, by orthonormal ones whose span contains theirs
/// (Householder). Throws Error if LAPACK fails.
void orthonormalise(DenseMatrix& x);

/// Returns the upper triangle R of A = Q R, min(m, n) × n, with orthonormal columns of Q. Throws
/// Error if LAPACK fails.
DenseMatrix triangularFactor(DenseMatrix a);

}  // namespace squeal::linalg
