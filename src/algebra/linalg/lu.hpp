// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Small dense linear systems, solved by LAPACK's LU with partial pivoting. Not collective.
#include <vector>

#include "algebra/linalg/dense.hpp"

namespace squeal::linalg {

/// The LU factors of a square matrix of doubles or complex numbers.
template <class Scalar>
class Lu {
 public:
  /// Takes and factorises a square matrix.
  explicit Lu(Dense<Scalar> matrix);
  /// Returns the smallest pivot divided by the largest, in magnitude; 0 if the matrix is singular
  /// or has an entry that is not a number.
  double pivotRatio() const { return pivotRatio_; }
  /// Replaces each zero pivot by the machine precision times the largest pivot, or by the machine
  /// precision itself if all pivots are zero. Solutions then point along the null vector, as
  /// inverse iteration requires.
  void raiseZeroPivots();
  /// Replaces B by A⁻¹ B, or by A⁻ᴴ B if `adjoint`. A zero pivot gives entries that are not finite.
  void solve(Dense<Scalar>& b, bool adjoint = false) const;
  /// Does the same for a single column.
  void solve(std::span<Scalar> b, bool adjoint = false) const;

 private:
  void solve(Scalar* b, PetscBLASInt columns, bool adjoint) const;
  Dense<Scalar> factors_;
  std::vector<PetscBLASInt> rows_;  // row exchanges
  double largest_ = 0, pivotRatio_ = 0;
};

}  // namespace squeal::linalg
