// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The inverse of a matrix that differs by a few unknowns from one already factorised. Not
/// collective.
#include <vector>

#include "steady/impedance/symmetric_inverse.hpp"

namespace squeal::impedance {

/// The inverse of a symmetric matrix A. Its unknowns are those of a factorised matrix B, without
/// some that are held at zero, and with some added ones. With W = (coupling, unit vectors of the
/// held unknowns), the unknowns (x, p) follow from the bordered system
///   B x + W y = b,   Wᵀ x + D y = (c, 0),   y = (p, forces that hold),
/// where D contains the stiffness of the added unknowns.
class BorderedInverse {
 public:
  BorderedInverse() = default;  ///< of B itself
  /// Takes the inverse of B and its diagonal, `coupling`, [unknown of B]×[added unknown], the
  /// stiffness of the added unknowns, and the indices of the held unknowns in B.
  BorderedInverse(const SymmetricInverse& base, const std::vector<double>& diagonal,
                  linalg::DenseMatrix coupling, const linalg::DenseMatrix& added,
                  const std::vector<PetscInt>& held);
  /// Returns true if A is positive definite by a margin that leaves half of the digits, as B must
  /// be. Otherwise complete() must not be called.
  bool isRegular() const { return isRegular_; }
  /// Replaces x = B⁻¹ b by the x of the bordered system, zero for held unknowns, and c by p. Each
  /// has one column per right-hand side.
  void complete(linalg::DenseMatrix& x, linalg::DenseMatrix& c) const;

 private:
  linalg::DenseMatrix border_, responses_;  // W, scaled, and B⁻¹ W
  linalg::DenseMatrix vectors_;             // eigenvectors of D − Wᵀ B⁻¹ W, scaled
  std::vector<double> values_, scale_;      // its eigenvalues, and the scale of each unknown
  std::vector<PetscInt> held_;
  bool isRegular_ = true;
};

}  // namespace squeal::impedance
