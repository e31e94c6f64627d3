// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The friction terms as products of matrices with few rows.
#include <string>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "eigen/pencil/pencil.hpp"

namespace squeal::pencil {

/// The friction terms of r contact nodes,
///   Σ_a f^a S_aᵀ Σ_X c_X s^k N_X,
/// with the friction f and the matrices X of the bodies. Each factor has one row for each of the
/// nodes, on all ranks together. An active set uses the rows of the nodes that slide.
struct FrictionFactors {
  /// [power of the friction] S_a, r × n, the slip rows: the motion of contact nodes along the slip,
  /// times the coefficient of f^a. Only the frictionExponent a of the term is used.
  std::vector<Term> slip;
  /// [matrix of the bodies] N_X = N X T, r × n: the normal forces due to X. Each term has the power
  /// k of X (stiffness 0, mass 2) and the exponents of c_X.
  std::vector<Term> normal;
  std::string missing;  ///< why the factors are not known; empty if they are

  /// Returns N_X of the stiffness (power 0) or of the mass (2).
  Mat normalOf(int power) const;
};

/// The factors that the friction terms of all points share. The terms of a point are
///   (Φ J)ᵀ Σ_X c_X s^k N_X + Jᵀ B (s J − v D),
/// with Φ and B of PointFactors and the speed v.
struct JumpFactors {
  OwnedMat jumps;            ///< J, q × n: the jumps of the displacement at the contact nodes
  OwnedMat convected;        ///< D, q × n; null if it is zero
  std::vector<Term> normal;  ///< N_X, r × n, as in FrictionFactors
  std::string missing;       ///< why the factors are not known; empty if they are
};

/// The factors of the friction terms of one point, the same on all ranks.
struct PointFactors {
  linalg::DenseMatrix slip;      ///< Φ at the friction of the point, r × q
  linalg::DenseMatrix response;  ///< B, q × q
};

}  // namespace squeal::pencil
