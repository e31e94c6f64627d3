// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Integrals of the dual functions of one slave face times the shape functions of both sides. The
/// dual function ψ_p of a pivot p is orthogonal to the functions φ̃_q of all other pivots q, so
/// each pivot has its own condition. Sources: Wohlmuth, SIAM J. Numer. Anal. 38 (2000); Popp,
/// Wohlmuth, Gee and Wall, SIAM J. Sci. Comput. 34 (2012).
#include <span>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "model/mortar/moments.hpp"

namespace squeal::mortar {

/// The functions χ_p of the pivots of a slave face, which span the dual functions; Σ χ_p = 1.
struct Pivots {
  std::vector<int> nodes;   ///< [pivot] node of the face
  std::vector<int> others;  ///< nodes that are not pivots
  /// [pivot][node]: χ_p = Σ functions(p, i) φ̃_i.
  linalg::DenseMatrix functions;
};

/// Returns the pivots of a face. Not collective. `dropped`, [node], marks nodes that get no
/// multiplier although `multiplier` assigns one to nodes of their kind. The functions of dropped
/// nodes are distributed equally among the pivots. If all nodes are dropped, there are no pivots.
Pivots pivots(const FaceType& type, Multiplier multiplier, const std::vector<bool>& dropped);

/// The coupling of a slave face to one master face:
///   M: ∫ ψ_p φ_l dA and C: ∫ ψ_p V·∇_S φ_l dA with the velocity V, [pivot][node of the master
///   face].
using MasterTerms = MasterMoments;

/// The integrals over one slave face, in m² (m in plane problems) unless noted. With D =
/// diag(slave),
///   D ũ_p + B ũ_o − M u_l
/// is the jump of displacements at a pivot, times W.
struct FaceTerms {
  std::vector<double> slave;  ///< D: ∫ ψ_p φ̃_p dA, [pivot]
  /// W: ∫ ψ_p dA, [pivot]; equal to the row sums of [D B], and to those of all M together
  std::vector<double> weight;
  linalg::DenseMatrix others;  ///< B: ∫ ψ_p φ̃_o dA, [pivot][other node]
  std::vector<double> gap;     ///< G: ∫ ψ_p gap dA, [pivot], m³ (m²)
  std::vector<MasterTerms> masters;
  std::vector<double> covered;  ///< ∫ φ̃_i dA over the covered part, [node]
  /// ∫ φ̃_i n dA over the covered part, [node]; n points out of the slave
  std::vector<Point> normal;
  /// False if ψ would be large because the covered part is too small or too thin to distinguish the
  /// functions. Then χ_p replaces ψ_p, and ∫ χ_p φ̃ dA of all nodes is lumped on the pivot: D = W =
  /// ∫ χ_p dA and B = 0. Uniform pressures, uniform displacements and the total force stay exact,
  /// but linear displacements do not.
  bool dual = true;
};

/// Integrates over the covered part of a slave face. `alpha` contains α of each edge, in the order
/// of FaceType::edges. Without cover or pivots there are no terms of masters, and D and W are zero.
/// Not collective.
FaceTerms integrate(const FaceMoments& moments, std::span<const double> alpha,
                    const Pivots& pivots);

/// Returns ∫ φ̃_i dA over the covered part of a face, [node], m² (m in plane problems), as in
/// FaceTerms::covered. Not collective.
std::vector<double> coveredIntegrals(const FaceMoments& moments, std::span<const double> alpha);

/// Returns ∫ φ̃_i dA over the whole face, covered or not, [node], m² (m in plane problems). Not
/// collective.
std::vector<double> wholeIntegrals(const Face& slave, std::span<const double> alpha);

}  // namespace squeal::mortar
