// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Bounds of P_CV P_VV⁻¹ P_VC around a point of the plane.
#include <optional>
#include <vector>

#include "eigen/proof/diagonal_form.hpp"

namespace squeal::proof {

/// The part of T = a D⁻¹ b of some poles, known by a bound that holds in a region.
struct FarPart {
  std::vector<unsigned char> poles;  ///< [pole] 1 if it belongs to the part
  double bound = 0;
};

/// The Taylor polynomial of T = a D⁻¹ b about a point z0, with all terms that it omits: for z = z0
/// + h,
///   T(z) = Σ hʲ T_j (j ≤ order) + h^(order + 1) R(h),
/// where R is a finite sum over the poles, so that the Taylor series need not converge. Not
/// collective.
class Expansion {
 public:
  /// Expands about z0. Borrows the form. With `omitted`, the pole of this number is not in T_j and
  /// R, and bound() adds its exact term.
  Expansion(const DiagonalForm& form, Complex centre, int order, PetscInt omitted = -1);

  /// Sums the terms of all poles except the far part, which needs no products of matrices. Borrows
  /// both.
  Expansion(const DiagonalForm& form, Complex centre, const FarPart& far, PetscInt omitted);

  Complex centre() const { return centre_; }
  /// Returns the bound of ‖P_CV P_VV⁻¹ P_VC‖ at the points z with |z − z0| ≤ radius that lie at
  /// least distance[k] from the eigenvalue k. Infinite if nothing is known.
  double bound(double radius, std::span<const double> distances) const;
  /// Returns the same on the circle |z − z0| = radius about the omitted pole.
  double boundOnCircle(double radius) const;
  /// Returns the same at z0 itself.
  double boundAtCentre() const { return bound(0, {}); }

 private:
  double sum(double radius, std::vector<double> inverses) const;
  const DiagonalForm& form_;
  Complex centre_;
  int order_;
  PetscInt omitted_;
  const FarPart* far_ = nullptr;
  std::vector<double> norms_;                             // ‖T_j‖
  std::vector<double> denominators_;                      // |D_k|
  std::vector<std::vector<double>> aLengths_, bLengths_;  // [j][k] of the Taylor coefficients
  std::vector<double> lastLengths_;  // of row k of the last coefficient of D⁻¹ b
};

}  // namespace squeal::proof
