// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The matrices of one point in symmetric and antisymmetric parts, and the energy of the proof.
#include <array>

#include "algebra/factor/associated_system.hpp"
#include "base/petsc/owned.hpp"
#include "eigen/pencil/pencil.hpp"

namespace squeal::referee {

/// P(s) = s² (M + M_a) + s (C + G) + K + K_a, the second matrix of each pair antisymmetric. A
/// matrix of zeros is null.
class SplitProblem {
 public:
  /// Collective. Splits the matrices of the point. Throws Error without mass or stiffness, or
  /// if the symmetric part of the mass is not positive semi-definite.
  SplitProblem(const pencil::Pencil& pencil, const sweep::Parameters& at);
  Mat symmetric(int power) const { return parts_[power][0]; }
  Mat skew(int power) const { return parts_[power][1]; }
  /// Returns true if there are terms in s.
  bool damped() const { return symmetric(1) || skew(1); }
  /// Returns the antisymmetric part of the stiffness relative to the stiffness, in the Frobenius
  /// norm.
  double asymmetry() const { return asymmetry_; }
  /// Collective. Returns the terms whose static responses start the basis: all but those of the
  /// energy.
  std::vector<pencil::Term> perturbations() const;

 private:
  std::array<std::array<OwnedMat, 2>, 3> parts_;  // [power][symmetric, antisymmetric]
  double asymmetry_ = 0;
};

/// K0 = K + σ M and M, both symmetric, with the smallest σ ≥ 0 of a sequence that makes K0 clearly
/// positive definite.
struct ShiftedSystem {
  factor::AssociatedSystem system;
  double shift = 0;  ///< σ, rad²/s²
};

/// Collective. Returns the system for a region up to `top`, rad/s. Throws Error if K + 16 top² M is
/// not positive definite.
ShiftedSystem shiftedSystem(const SplitProblem& problem, double top);

}  // namespace squeal::referee
