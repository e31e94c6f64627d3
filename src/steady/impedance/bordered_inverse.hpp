// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The inverse of a matrix that differs by a few unknowns from one already factorised. Not
/// collective.
#include <vector>

#include "steady/impedance/symmetric_inverse.hpp"

namespace squeal::impedance {

/// The inverse of a symmetric matrix A. The unknowns of A are those of a factorised matrix B,
/// except some that are held at zero, plus some added ones. With W = (coupling, unit vectors of the
/// held unknowns), the unknowns x of B and the added unknowns p follow from the bordered system
///   B x + W y = b,   Wᵀ x + D y = (c, 0),   y = (p, holding forces),
/// where D contains the stiffness of the added unknowns.
class BorderedInverse {
 public:
  BorderedInverse() = default;  ///< the inverse of B itself
  /// `base` is the inverse of B, `diagonal` the diagonal of B, `coupling` [unknown of B]×[added
  /// unknown], `added` the stiffness of the added unknowns, and `held` the indices of the held
  /// unknowns in B.
  BorderedInverse(const SymmetricInverse& base, const std::vector<double>& diagonal,
                  linalg::DenseMatrix coupling, const linalg::DenseMatrix& added,
                  const std::vector<PetscInt>& held);
  /// Returns true if A and B are positive definite by a margin that leaves half of the digits.
  /// Otherwise complete() must not be called.
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
