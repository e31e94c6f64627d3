// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The part of the basis V on which the proof for a point is carried out. Not collective.
#include "algebra/linalg/dense.hpp"

namespace squeal::completeness {

/// The known properties of the free modes in V.
struct KnownModes {
  PetscInt first = 0, count = 0;  ///< the modes are `count` columns of V from `first` on, after the
                                  ///< constraint modes
  double theta = 0;  ///< V contains all modes of the interior unknowns with ω² < θ, rad²/s²
  double error = 0;  ///< ‖M0 d − K0 d/λ‖ of all modes together, in the norm of K0⁻¹, s²
};

/// The span of the constraint modes, the free modes and static responses, in coordinates in which V
/// is orthonormal in energy. It contains the modes as its first unit vectors.
class KeptSpan {
 public:
  /// `energy` is Vᵀ K0 V. `rows` is F V for the forces Fᵀ to which V contains the responses K0⁻¹
  /// Fᵀ.
  KeptSpan(const KnownModes& modes, const linalg::DenseMatrix& energy,
           const linalg::DenseMatrix& rows);
  /// Returns L with energy = L Lᵀ.
  const linalg::DenseMatrix& factor() const { return factor_; }
  /// Returns L⁻ᵀ: the columns of V L⁻ᵀ are orthonormal.
  const linalg::DenseMatrix& turn() const { return turn_; }
  /// Returns a bound of ‖F x‖ for all x of energy 1 in the space of V that are orthogonal to the
  /// span.
  double forcesLeft() const { return forcesLeft_; }
  /// Returns orthonormal columns W that span the span.
  linalg::DenseMatrix vectors() const { return withModes(responses_); }
  /// Returns orthonormal columns W that also span `more`, in coordinates of V, and the responses to
  /// forces f, within 1e-7 of the length of each. V contains these responses, and the columns of
  /// `forces` are Vᵀ f.
  linalg::DenseMatrix vectorsWith(const linalg::DenseMatrix& more,
                                  const linalg::DenseMatrix& forces = {}) const;

 private:
  linalg::DenseMatrix withModes(const linalg::DenseMatrix& others) const;
  linalg::DenseMatrix extended(linalg::DenseMatrix orthonormal) const;
  PetscInt fixed_;  // number of modes of both kinds
  linalg::DenseMatrix factor_, turn_;
  linalg::DenseMatrix responses_;  // orthonormal, in the coordinates after those of the modes
  double forcesLeft_ = 0;
};

}  // namespace squeal::completeness
