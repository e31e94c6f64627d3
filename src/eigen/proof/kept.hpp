// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A problem P(s) on two spaces: a small space V, on which P is known, and the space C that V
/// leaves out, on which only bounds of P are known.
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "algebra/linalg/dense.hpp"

namespace squeal::proof {

/// Coefficients of s⁰, s¹ and s². An empty matrix means zero.
using Coefficients = std::array<linalg::DenseMatrix, 3>;

/// A majorant of a block that couples V and C. For P_CV it is F(s) = Σ sᵏ F_k, rows × N, with
///   P_CV(s) = W F(s) + remainder,   ‖W‖ ≤ 1,   ‖remainder‖ ≤ Σ |s|ᵏ e_k,
/// where W is unknown and may depend on s. For P_VC it is E(s) = Σ sᵏ E_k, N × columns, with
///   P_VC(s) = E(s) W + remainder.
/// The exact block is its own majorant, with W = 1.
struct Coupling {
  Coefficients coefficients;         ///< F_k or E_k
  std::array<double, 3> error = {};  ///< e_k
};

/// The blocks of P(s) on V and between V and C. C is orthogonal to V in the energy K0, and its
/// basis is orthonormal in this energy. V may have any basis; the bounds e_k hold in that basis.
/// Each part of a coupling has its own W.
struct KeptProblem {
  Coefficients matrices;              ///< of P_VV, N × N
  std::vector<Coupling> toLeftOut;    ///< parts of P_CV, rows × N
  std::vector<Coupling> fromLeftOut;  ///< parts of P_VC, N × columns
  /// The majorants hold for |s| up to this, rad/s.
  double reach = std::numeric_limits<double>::infinity();
  PetscInt order() const;  ///< N
};

/// Bounds of the block of P on the space C, in coordinates that are orthonormal in the energy K0:
///   P_CC(s) = 1 + (s² − σ) M + s² M_a + s (D + G) + rest,
/// where M and D are the symmetric parts of mass and damping, and M_a and G the antisymmetric ones.
struct LeftOut {
  /// Upper bound of M ≥ 0, unit second²; it is 1/θ if V contains all modes of K0 d = λ M d with
  /// λ < θ.
  double mass = 0;
  double shift = 0;       ///< σ ≥ 0 of K0 = K + σ M, rad²/s²
  double skewMass = 0;    ///< ‖M_a‖, second²
  double damping = 0;     ///< upper bound of the damping matrix D ≥ 0, second
  double gyroscopic = 0;  ///< ‖G‖, second
  /// The norm of the sum of all other terms is at most Σ |s|ᵏ rest[k].
  std::array<double, 3> rest = {};
};

/// Returns
///   δ = 1 − (reach² + σ) mass − reach² skewMass − max(left, 0) damping − reach gyroscopic
///       − Σ reachᵏ rest[k],
/// a lower bound of Re xᴴ P_CC(s) x for ‖x‖ = 1, |s| ≤ reach and Re s ≥ −left.
double definiteness(const LeftOut& bounds, double reach, double left);

/// Returns a majorant of P_CV from an upper bound of the Gram matrix of its coefficients C_k, for
/// the listed powers of s:
///   gram ≥ [C_0, C_1, …]ᵀ [C_0, C_1, …]   in the sense of quadratic forms.
/// `gram` is square, of order N times the number of powers. Directions within round-off are dropped
/// and counted in the error. `top`, rad/s, sets the relative weights of the powers. Directions in
/// which the norm of the block is at most `negligible` for |s| = top are dropped and counted in the
/// error as well. Throws Error if `gram` has a negative eigenvalue beyond round-off.
Coupling couplingFromGram(const linalg::DenseView& gram, std::span<const int> powers, double top,
                          double negligible = 0);

/// Returns the majorant of P_VC from `coupling`, the result of couplingFromGram() for the
/// transposed coefficients of P_VC.
Coupling transposed(const Coupling& coupling);

}  // namespace squeal::proof
