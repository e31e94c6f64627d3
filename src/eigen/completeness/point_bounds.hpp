// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The block of P(s) on the basis V at a point of the sweep, or on a part of V, and bounds of the
/// blocks that couple it with C, the space that it leaves out. docs/method.md, section 13, derives
/// the bounds. Not collective.
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "algebra/linalg/quadratic.hpp"
#include "eigen/completeness/kept_span.hpp"
#include "eigen/proof/kept.hpp"

namespace squeal::completeness {

/// The products with V that all points with the same active set share. V has N vectors, first the
/// constraint modes and the free modes. K0⁻¹ is that of the interior unknowns.
struct SetMatrices {
  KnownModes modes;
  linalg::DenseMatrix energy, mass;  ///< Vᵀ K0 V and Vᵀ M0 V, N × N
  linalg::DenseMatrix massProduct;   ///< Vᵀ M0 K0⁻¹ M0 V, N × N
  /// [power of the friction] S_a V, r × N, and S_a K0⁻¹ S_aᵀ, r × r. V contains K0⁻¹ S_aᵀ.
  std::vector<linalg::DenseMatrix> slip, slipFlexibility;
  linalg::DenseMatrix normal, inertia;                        ///< N_0 V and N_2 V, r × N
  linalg::DenseMatrix normalFlexibility, inertiaFlexibility;  ///< N_k K0⁻¹ N_kᵀ, r × r
};

/// The products and bounds of an active set in coordinates in which V is orthonormal in energy. W
/// spans the modes and the responses K0⁻¹ S_aᵀ. C is what any part of V that contains W leaves out.
struct SetBounds {
  KnownModes modes;
  KeptSpan span;                          ///< the coordinates, and W
  double reach;                           ///< the bounds hold for |s| up to this, rad/s
  double massOnC;                         ///< upper bound of M0 on C, s²
  linalg::DenseMatrix mass, massProduct;  ///< M0 and M0 K0⁻¹ M0 on V
  std::vector<linalg::DenseMatrix> slip;  ///< [power of the friction] S_a V
  std::vector<double> slipOnC;            ///< [power of the friction] bound of ‖S_a‖ on C
  linalg::DenseMatrix forces;    ///< N_0C + s² N_2C = forces · X with ‖X‖ ≤ 1, r × r
  double normal, inertia;        ///< ‖N_0 V‖ and ‖N_2 V‖
  double normalOnC, inertiaOnC;  ///< ‖N_0C‖ and ‖N_2C‖
};

/// Returns the bounds of a set for |s| up to `reach`, rad/s. Throws Error if a Gram matrix has a
/// negative eigenvalue beyond round-off.
SetBounds setBounds(const SetMatrices& set, double reach);

/// The data of a point.
struct PointMatrices {
  linalg::DenseProblem problem;     ///< P(s) on V; Z is empty
  std::vector<double> slipFactors;  ///< [power of the friction] its factor at this point
};

/// The blocks for the proof.
struct PointBounds {
  proof::KeptProblem kept;
  proof::LeftOut leftOut;
};

/// Returns the blocks of a point on the part of V with these vectors, which contains W, in the
/// coordinates in which V is orthonormal (KeptSpan::vectorsWith(), or the unit matrix for all of
/// V). Throws Error if V lacks modes below θ.
PointBounds pointBounds(const SetBounds& set, const PointMatrices& point,
                        const linalg::DenseMatrix& w);

}  // namespace squeal::completeness
