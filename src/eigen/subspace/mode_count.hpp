// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The number of free modes below a frequency for any set of boundary unknowns, without another
/// factorisation [M.61]. substructure.hpp defines the boundary unknowns w, Y and S.
///
/// Let Φ be the modes of the interior unknowns, complete below β, and let Z be the space of the
/// vectors with w = 0 that are orthogonal to Φ in energy. On Z, K − σM is positive definite for
/// σ < β. If Z is eliminated from K − σM, the matrix that remains on Φ and the constraint modes Y
/// therefore has as many negative eigenvalues as there are modes below σ:
///   count = number of λ_i < σ + number of negative eigenvalues of G − C,
///   G = S − σ YᵀM Y − σ² Pᵀ (Λ − σ)⁻¹ P,   P = ΦᵀM Y,
///   0 ≤ C ≤ σ²/(1 − σ/β) D,   D = QᵀK0⁻¹Q − PᵀΛ⁻¹P,   Q = M Y in the rows of the interior,
/// where Λ contains the eigenvalues λ_i of Φ, and C is the part due to Z. The two bounds of C give
/// bounds of the count, which agree for most σ. The solves for D are often not needed, since
///   D ≤ (YᵀM Y − PᵀP)/β.
/// A point uses only the rows and columns of its own boundary unknowns.
#include <optional>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/subspace/basis.hpp"

namespace squeal::subspace {

class ModeCount {
 public:
  /// Not collective. `basis` must still begin with its constraint modes, followed by `modes`.
  /// `mass` is VᵀMV for these vectors. The arguments may be destroyed after the call.
  ModeCount(const Basis& basis, const modes::Modes& modes, const linalg::DenseMatrix& mass);
  /// Collective. Replaces the bound of D by D itself, with a block solve for all constraint modes.
  /// `mass` is M of all unknowns.
  void sharpen(Basis& basis, Mat mass);
  /// Returns true if sharpen() would not help.
  bool isSharp() const { return isSharp_; }
  /// Not collective. Returns the number of modes below σ, rad²/s², of a point with the boundary
  /// unknowns `own`, in ascending order; std::nullopt if the number is uncertain.
  std::optional<int> below(double sigma, const std::vector<PetscInt>& own) const;

 private:
  std::vector<double> lambda_;                           // ω² of the modes of the interior
  double complete_ = 0;                                  // β; 0 if unknown
  linalg::DenseMatrix stiffness_, mass_, modal_, rest_;  // S, YᵀM Y, P, and D or its bound
  bool isSharp_ = false;
};

}  // namespace squeal::subspace
