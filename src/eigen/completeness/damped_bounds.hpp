// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The block of P(s) on a part of the basis V, and bounds of the other blocks, at points with
/// damping, rotation, or friction that depends on the steady state. docs/method.md, section 13,
/// derives the bounds. Not collective.
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "eigen/completeness/point_bounds.hpp"
#include "eigen/pencil/friction_factors.hpp"

namespace squeal::completeness {

/// The products with V that all points with the same active set share. V has N vectors, first the
/// constraint modes. N_X, J and D are those of pencil::JumpFactors; of J and D only the rows in
/// which J is not zero. K0⁻¹ is that of the interior unknowns.
struct DampedSet {
  /// A matrix X of the bodies, symmetric or antisymmetric, whose term is c s^power X.
  struct Body {
    int power = 0;
    bool skew = false;
    linalg::DenseMatrix onV;  ///< Vᵀ X V, N × N
    /// On C, in the energy K0: bound of ‖X‖; of X + κ H (see `below`) if X is a damping matrix.
    double bound = 0;
    /// If X is a damping matrix: X + κ H ≥ 0 and ‖κ H‖ ≤ below on C (proof::MatrixBounds).
    double below = 0;
  };
  /// N_X of one of the matrices X.
  struct Normal {
    int power = 0;
    linalg::DenseMatrix onV, flexibility;  ///< N_X V, r × N, and N_X K0⁻¹ N_Xᵀ, r × r
    linalg::DenseMatrix mass;              ///< N_X K0⁻¹ M0 V, r × N; only of stiffness and mass
  };

  KnownModes modes;
  linalg::DenseMatrix energy;  ///< Vᵀ K0 V, N × N
  linalg::DenseMatrix mass;    ///< Vᵀ M0 V, N × N
  std::vector<Body> bodies;    ///< except K0, M0 and those without effect
  /// [i][j ≤ i] Vᵀ X_iᵀ K0⁻¹ X_j V, N × N; X_0 = M0, and X_(i + 1) is that of bodies[i]. Empty if
  /// j < i and one of the two matrices belongs to s⁰.
  std::vector<std::vector<linalg::DenseMatrix>> products;
  std::vector<Normal> normals;        ///< [0]: of the stiffness, [1]: of the mass
  linalg::DenseMatrix normalProduct;  ///< N_X K0⁻¹ N_X'ᵀ of stiffness X and mass X', r × r
  linalg::DenseMatrix jumps;          ///< J V, q × N
  double jumpsOnC = 0;  ///< estimated bound of ‖J x‖ for x of energy 1 orthogonal to V
  linalg::DenseMatrix convected, convectedFlexibility;  ///< D V, D K0⁻¹ Dᵀ; empty if D is null
};

/// The data of a point.
struct DampedPoint {
  linalg::DenseProblem problem;       ///< P(s) on V
  std::vector<double> bodyFactors;    ///< [body] c
  std::vector<double> normalFactors;  ///< [normal] c
  double speed = 0;                   ///< v
  pencil::PointFactors friction;      ///< Φ and B
  /// Approximate eigenvectors in coordinates of V, N × any number.
  linalg::DenseMatrix vectors;
  /// Vᵀ f for forces f; V contains the responses K0⁻¹ f. N × any number.
  linalg::DenseMatrix forces;
};

/// Returns the blocks on the part of V that contains the modes, the responses to forces at the
/// jumps, the approximate eigenvectors of the point, and the responses to its forces. The bounds
/// hold for |s| up to 1.3 `top`, rad/s; `top` also sets the relative weights of the powers of s.
/// Throws Error if a Gram matrix has a negative eigenvalue beyond round-off, or if the factors of
/// friction do not give the terms of the problem.
PointBounds dampedBounds(const DampedSet& set, DampedPoint point, double top);

}  // namespace squeal::completeness
