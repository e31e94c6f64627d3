// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The matrices of one point, split into symmetric and antisymmetric parts, and the energy of the
/// proof.
#include <array>

#include "algebra/factor/associated_system.hpp"
#include "base/petsc/owned.hpp"
#include "eigen/pencil/pencil.hpp"

namespace squeal::referee {

/// P(s) = s² (M + M_a) + s (C + G) + K + K_a, with symmetric M, C and K and antisymmetric M_a, G
/// and K_a. The handle of a zero matrix is null.
class SplitProblem {
 public:
  /// Collective. Splits the matrices of the point. Throws Error without a mass or a stiffness,
  /// or if the symmetric part of the mass, without its rows of zeros, is not positive definite.
  SplitProblem(const pencil::Pencil& pencil, const sweep::Parameters& at);
  Mat symmetric(int power) const { return parts_[power][0]; }
  Mat skew(int power) const { return parts_[power][1]; }
  /// Returns true if there are terms in s.
  bool damped() const { return symmetric(1) || skew(1); }
  /// Returns ‖K − Kᵀ‖ / ‖K‖ of the stiffness K in the Frobenius norm.
  double asymmetry() const { return asymmetry_; }
  /// Collective. Returns all terms except the symmetric stiffness and mass, which form the energy,
  /// and except antisymmetric parts of stiffness and mass that may be due to a limited number of
  /// printed digits. The static responses to the forces of the returned terms start the basis.
  std::vector<pencil::Term> perturbations() const;

 private:
  std::array<std::array<OwnedMat, 2>, 3> parts_;  // [power][symmetric, antisymmetric]
  double asymmetry_ = 0;
};

/// K0 = K + σ M and M, both symmetric, with σ = 2 σ_1 ≥ 0. Here σ_1 is the smallest shift of a
/// sequence for which K + σ_1 M is positive definite.
struct ShiftedSystem {
  factor::AssociatedSystem system;
  double shift = 0;  ///< σ, rad²/s²
};

/// Collective. Returns the system for a region up to `top`, rad/s. Throws Error if K + 16 top² M is
/// not positive definite.
ShiftedSystem shiftedSystem(const SplitProblem& problem, double top);

}  // namespace squeal::referee
