// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The blocks of a point on the basis V, and bounds of those that couple it with the space C that V
/// leaves out. docs/method.md, section 13, derives the bounds. Not collective.
#include "algebra/linalg/dense.hpp"
#include "algebra/linalg/quadratic.hpp"
#include "eigen/proof/kept.hpp"

namespace squeal::completeness {

/// What is known about the modes in V.
struct KnownModes {
  PetscInt first = 0, count = 0;  ///< columns of V; constraint modes come before them
  double theta = 0;               ///< V has all interior modes with ω² below θ, rad²/s²
  double error = 0;               ///< ‖M0 d − d/λ‖ of all modes together, in energy, s²
};

/// The blocks of an active set that couple V and C, from products with V and from static responses.
struct SetMatrices {
  KnownModes modes;
  linalg::DenseMatrix energy;  ///< K0 on V, N × N
  /// M_VC M_CV in the coordinates of energy = L Lᵀ, N × N, except the rows and columns of the
  /// modes.
  linalg::DenseMatrix leftMass;
  linalg::DenseMatrix normal, inertia;          ///< N_0 V and N_2 V, r × N
  linalg::DenseMatrix leftNormal, leftInertia;  ///< N_0C N_0Cᵀ and N_2C N_2Cᵀ, r × r
};

/// Bounds of these blocks, which all points of the set share.
struct SetBounds {
  double mass;                     ///< M on C is at most this, s²
  proof::Coupling toLeftOut;       ///< s² M_CV
  linalg::DenseMatrix forces;      ///< N_0C + s² N_2C = forces · W with ‖W‖ ≤ 1, r × r
  double normal, inertia;          ///< ‖N_0 V‖ and ‖N_2 V‖
  double leftNormal, leftInertia;  ///< ‖N_0C‖ and ‖N_2C‖
};

/// Returns the bounds of a set for |s| up to `reach`, rad/s. Throws Error if modes below θ are
/// missing in V, or if a matrix of squares has a negative eigenvalue.
SetBounds setBounds(const SetMatrices& set, double reach);

/// A point in coordinates of V.
struct PointMatrices {
  linalg::DenseProblem problem;  ///< P(s), without Z
  linalg::DenseMatrix slip;      ///< S V at this friction, r × N; empty without friction
  double slipError = 0;          ///< ‖S x‖ of x in C with energy 1
};

/// The blocks for the proof.
struct PointBounds {
  proof::KeptProblem kept;
  proof::LeftOut leftOut;
};

/// Returns the blocks of a point. Takes its matrices.
PointBounds pointBounds(const SetBounds& set, PointMatrices point);

}  // namespace squeal::completeness
