// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// This file holds the QR factorisation of small dense matrices, by LAPACK. Not collective.
#include "algebra/linalg/dense.hpp"

namespace squeal::linalg {

/// A Qr is the factorisation A = Q [R; 0] of a matrix with no more columns than rows, with Q square
/// and orthogonal.
class Qr {
 public:
  /// Factorises A, m × n with m ≥ n. Throws Error if LAPACK fails.
  explicit Qr(const DenseView& a);
  const DenseMatrix& q() const { return q_; }  ///< m × m
  /// Replaces B, with n columns, by B R⁻¹. R has to be regular.
  void divideByR(DenseMatrix& b) const;

 private:
  DenseMatrix q_, r_;  // R in the upper triangle
};

}  // namespace squeal::linalg
