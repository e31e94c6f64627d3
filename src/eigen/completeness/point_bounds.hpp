// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The block of P(s) on the basis V at a point of the sweep, and bounds of the blocks that couple V
/// with C, the space that V leaves out. docs/method.md, section 13, derives the bounds. Not
/// collective.
#include "algebra/linalg/dense.hpp"
#include "algebra/linalg/quadratic.hpp"
#include "eigen/proof/kept.hpp"

namespace squeal::completeness {

/// The known properties of the free modes in V.
struct KnownModes {
  PetscInt first = 0, count = 0;  ///< the modes are `count` columns of V from `first` on, after the
                                  ///< constraint modes
  double theta = 0;  ///< V contains all modes of the interior unknowns with ω² < θ, rad²/s²
  double error = 0;  ///< ‖M0 d − K0 d/λ‖ of all modes together, in the norm of K0⁻¹, s²
};

/// Data of the blocks that couple V and C for an active set, from products with V and from static
/// responses.
struct SetMatrices {
  KnownModes modes;
  linalg::DenseMatrix energy;  ///< K0 on V, N × N
  /// M_VC M_CV, N × N, in the basis V L⁻ᵀ, which is orthonormal in the energy; energy = L Lᵀ. The
  /// rows and columns of the modes are not used.
  linalg::DenseMatrix leftMass;
  linalg::DenseMatrix normal, inertia;          ///< N_0 V and N_2 V, r × N
  linalg::DenseMatrix leftNormal, leftInertia;  ///< N_0C N_0Cᵀ and N_2C N_2Cᵀ, r × r
};

/// Bounds of the blocks on C and between V and C that hold at all points of an active set.
struct SetBounds {
  double reach;                    ///< the bounds hold for |s| up to this, rad/s
  double mass;                     ///< upper bound of M on C, s²
  proof::Coupling toLeftOut;       ///< majorant of s² M_CV
  linalg::DenseMatrix forces;      ///< N_0C + s² N_2C = forces · W with ‖W‖ ≤ 1, r × r
  double normal, inertia;          ///< ‖N_0 V‖ and ‖N_2 V‖
  double leftNormal, leftInertia;  ///< ‖N_0C‖ and ‖N_2C‖
};

/// Returns the bounds of a set for |s| up to `reach`, rad/s. Throws Error if V lacks modes below θ,
/// or if a Gram matrix has a negative eigenvalue beyond round-off.
SetBounds setBounds(const SetMatrices& set, double reach);

/// The matrices of a point in coordinates of V.
struct PointMatrices {
  linalg::DenseProblem problem;  ///< P(s); Z is empty
  linalg::DenseMatrix slip;      ///< S V at this friction, r × N; empty without friction
  double slipError = 0;          ///< bound of ‖S x‖ for all x in C with energy 1
};

/// The blocks for the proof.
struct PointBounds {
  proof::KeptProblem kept;
  proof::LeftOut leftOut;
};

/// Returns the blocks of a point from its matrices.
PointBounds pointBounds(const SetBounds& set, PointMatrices point);

}  // namespace squeal::completeness
