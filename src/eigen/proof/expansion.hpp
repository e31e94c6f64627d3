// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Bounds of P_CV P_VV⁻¹ P_VC (kept.hpp) around a point of the plane of z. D, a, b and z are those
/// of the diagonal form (diagonal_form.hpp), and its eigenvalues are the poles.
#include <optional>
#include <vector>

#include "eigen/proof/diagonal_form.hpp"

namespace squeal::proof {

/// A part of T = a D⁻¹ b: the sum of the terms of some of the poles, with a bound of its norm in a
/// region.
struct FarPart {
  std::vector<unsigned char> poles;  ///< [pole] 1 if its term belongs to the sum
  double bound = 0;
};

/// The Taylor polynomial of T = a D⁻¹ b about a point z0, with its exact remainder: for z = z0 + h,
///   T(z) = Σ hʲ T_j (j ≤ order) + h^(order + 1) R(h),
/// where R is a finite sum over the poles, so that the Taylor series need not converge. Not
/// collective.
class Expansion {
 public:
  /// Expands about z0. Borrows the form. T_j and R do not contain the term of the pole with the
  /// index `omitted`, if it is given; bound() adds this term exactly.
  Expansion(const DiagonalForm& form, Complex centre, int order, PetscInt omitted = -1);

  /// Uses the bound of the far part, and bounds the terms of the other poles one by one. This needs
  /// no products of matrices. Borrows the form and the far part.
  Expansion(const DiagonalForm& form, Complex centre, const FarPart& far, PetscInt omitted);

  Complex centre() const { return centre_; }
  /// Returns a bound of ‖P_CV P_VV⁻¹ P_VC‖ for all z with |z − z0| ≤ radius whose distance from
  /// each pole k is at least distances[k]; infinite if no bound is known.
  double bound(double radius, std::span<const double> distances) const;
  /// Returns such a bound on the circle |z − z0| = radius about the omitted pole.
  double boundOnCircle(double radius) const;
  /// Returns such a bound at z0 itself.
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
  std::vector<std::vector<double>> aSizes_;  // [j][k] bounds of the terms whose sums are a
  std::vector<double> lastLengths_;          // [k] of row k of the last coefficient of D⁻¹ b
};

}  // namespace squeal::proof
