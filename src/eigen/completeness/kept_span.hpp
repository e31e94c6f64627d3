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
  /// Norm, in K0⁻¹, of the residuals M0 d − K0 d/λ of all free modes d together, λ = ω², s².
  double error = 0;
};

/// Returns F K0⁻¹ Fᵀ on the space that orthonormal vectors leave out: `flexibility` is that of all
/// interior unknowns, and `onKept` is F times the vectors, of which the first `boundary` are not of
/// the interior.
linalg::DenseMatrix leftOf(linalg::DenseMatrix flexibility, const linalg::DenseMatrix& onKept,
                           PetscInt boundary);

/// The span of the constraint modes, the free modes and static responses. Its vectors are given in
/// the basis V L⁻ᵀ, which is orthonormal in energy. In this basis the constraint modes and the free
/// modes span the same space as the first unit vectors.
class KeptSpan {
 public:
  /// `energy` is Vᵀ K0 V, and `rows` is F V. The columns of Fᵀ are forces, and V contains their
  /// static responses K0⁻¹ Fᵀ.
  KeptSpan(const KnownModes& modes, const linalg::DenseMatrix& energy,
           const linalg::DenseMatrix& rows);
  /// Returns L with energy = L Lᵀ.
  const linalg::DenseMatrix& factor() const { return factor_; }
  /// Returns L⁻ᵀ.
  const linalg::DenseMatrix& turn() const { return turn_; }
  /// Returns a bound of ‖F x‖ for all x of energy 1 in the space of V that are orthogonal to the
  /// span.
  double forcesLeft() const { return forcesLeft_; }
  /// Returns orthonormal columns W, a basis of the span.
  linalg::DenseMatrix vectors() const { return withModes(responses_); }
  /// Returns orthonormal columns W, a basis of the span and further vectors: the columns of `more`,
  /// which are given in coordinates of V, and the responses to forces f. V contains these
  /// responses, and the columns of `forces` are Vᵀ f. What W leaves out of a further vector is at
  /// most 1e-7 of its length.
  linalg::DenseMatrix vectorsWith(const linalg::DenseMatrix& more,
                                  const linalg::DenseMatrix& forces = {}) const;

 private:
  linalg::DenseMatrix withModes(const linalg::DenseMatrix& others) const;
  linalg::DenseMatrix extended(linalg::DenseMatrix orthonormal) const;
  PetscInt fixed_;  // number of constraint modes and free modes
  linalg::DenseMatrix factor_, turn_;
  // An orthonormal basis of the responses without their part along the modes, in the coordinates
  // from fixed_ on.
  linalg::DenseMatrix responses_;
  double forcesLeft_ = 0;
};

}  // namespace squeal::completeness
