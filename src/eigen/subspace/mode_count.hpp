// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The number of free modes below a frequency is known for any set of boundary unknowns without
/// another factorisation [M.61].
///
/// Let the modes Φ of the interior be complete below β, and let Z be what is orthogonal to them in
/// energy, with w = 0. There K − σM is positive definite for σ < β, so that the modes below σ are
/// counted by the Schur complement of K − σM on Φ and the constraint modes Y:
///   count = number of λ_i < σ + negative eigenvalues of G − C,
///   G = S − σ YᵀM Y − σ² Pᵀ (Λ − σ)⁻¹ P,   P = ΦᵀM Y,
///   0 ≤ C ≤ σ²/(1 − σ/β) D,   D = QᵀK0⁻¹Q − PᵀΛ⁻¹P,   Q = M Y in the rows of the interior.
/// The two bounds of C bound the count, and for most σ agree. A point has the rows and columns of
/// its own boundary unknowns.
#include <optional>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/subspace/basis.hpp"

namespace squeal::subspace {

class ModeCount {
 public:
  /// Collective. `basis` must still hold the modes, and its constraint modes are solved for once
  /// more. `mass` is M of all unknowns. Nothing is needed afterwards.
  ModeCount(Basis& basis, const modes::Modes& modes, Mat mass);
  /// Not collective. Returns the number of modes below σ, rad²/s², of a point with the boundary
  /// unknowns `own`, ascending; none if that is not certain.
  std::optional<int> below(double sigma, const std::vector<PetscInt>& own) const;

 private:
  std::vector<double> lambda_;                           // of the interior
  double complete_ = 0;                                  // β; 0 if it is not known
  linalg::DenseMatrix stiffness_, mass_, modal_, rest_;  // S, YᵀM Y, P and D
};

}  // namespace squeal::subspace
