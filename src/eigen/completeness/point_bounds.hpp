// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// P(s) at a point of the sweep: its block on the basis V or on a part of V, and bounds of the
/// blocks that couple this part with C, the space left out. docs/method.md, section 13, derives
/// the bounds. Not collective.
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "algebra/linalg/quadratic.hpp"
#include "eigen/completeness/kept_span.hpp"
#include "eigen/proof/kept.hpp"

namespace squeal::completeness {

/// The products with V that all points with the same active set share. V has N vectors, first the
/// constraint modes and the free modes. K0⁻¹ is the inverse of K0 on the interior unknowns. S_a are
/// the slip rows that f^a multiplies, N_0 and N_2 the rows of the normal forces due to stiffness
/// and mass (pencil::FrictionFactors); each has r rows.
struct SetMatrices {
  KnownModes modes;
  linalg::DenseMatrix energy, mass;  ///< Vᵀ K0 V and Vᵀ M0 V, N × N
  PetscInt solved = 0;               ///< the last vectors of V from this one on are responses
  /// Vᵀ M0 K0⁻¹ M0 V, N × N, except where both vectors are these responses
  linalg::DenseMatrix massProduct;
  /// [a] S_a V, r × N, and S_a K0⁻¹ S_aᵀ, r × r. V contains K0⁻¹ S_aᵀ.
  std::vector<linalg::DenseMatrix> slip, slipFlexibility;
  linalg::DenseMatrix normal, inertia;                        ///< N_0 V and N_2 V, r × N
  linalg::DenseMatrix normalFlexibility, inertiaFlexibility;  ///< N_k K0⁻¹ N_kᵀ, r × r
};

/// The products and bounds of an active set in coordinates in which V is orthonormal in energy. W
/// spans the modes and the responses K0⁻¹ S_aᵀ. C is the space that the kept part of V leaves out;
/// the bounds hold for every part that contains W.
struct SetBounds {
  KnownModes modes;
  KeptSpan span;                          ///< the coordinates, and W
  double reach;                           ///< the bounds hold for |s| up to this, rad/s
  double massOnC;                         ///< upper bound of M0 on C, s²
  linalg::DenseMatrix mass;               ///< M0 on V
  linalg::DenseMatrix massProduct;        ///< at least M0 K0⁻¹ M0 on V
  std::vector<linalg::DenseMatrix> slip;  ///< [a] S_a V
  std::vector<double> slipOnC;            ///< [a] bound of ‖S_a‖ on C
  linalg::DenseMatrix forces;             ///< r × r; N_0C + s² N_2C = forces · X, ‖X‖ ≤ 1
  double normal, inertia;                 ///< upper bounds of ‖N_0 V‖ and ‖N_2 V‖
  double normalOnC, inertiaOnC;           ///< upper bounds of ‖N_0C‖ and ‖N_2C‖
};

/// Returns the bounds of a set for |s| up to `reach`, rad/s. Throws Error if a Gram matrix has a
/// negative eigenvalue beyond round-off.
SetBounds setBounds(const SetMatrices& set, double reach);

/// The data of a point.
struct PointMatrices {
  linalg::DenseProblem problem;     ///< P(s) on V, without a damping matrix
  std::vector<double> slipFactors;  ///< [a] the factor of S_a at this point
};

/// The blocks for the proof.
struct PointBounds {
  proof::KeptProblem kept;
  proof::LeftOut leftOut;
};

/// Returns the blocks of a point on the span of the columns of `w`, which must contain W. The
/// columns are in the coordinates in which V is orthonormal: those of KeptSpan::vectorsWith(), or
/// the unit matrix for all of V. Throws Error if V lacks free modes with ω² < θ (KnownModes).
PointBounds pointBounds(const SetBounds& set, const PointMatrices& point,
                        const linalg::DenseMatrix& w);

}  // namespace squeal::completeness
