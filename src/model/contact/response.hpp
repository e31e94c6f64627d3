// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The matrix B: a change w* of the relative velocity changes the friction forces by −B w* [4.7,
/// M.20].
#include <vector>

#include "model/contact/contact.hpp"

namespace squeal::contact {

/// The factors of B for one contact node. A change w* of its relative velocity changes its friction
/// force by −B w* [4.7, M.20]:
///   B = across (1 − ττᵀ − nnᵀ) + along ττᵀ.
struct VelocityResponse {
  double across = 0;  ///< f R_N φ / |w|, N·s/m; zero in plane problems, which have one tangent
  double along = 0;   ///< f R_N dφ/d|w|, N·s/m
};
/// Not collective. Returns these factors for the normal force R_N, in newtons. `slip` and the swept
/// `friction` give the coefficient of friction f.
VelocityResponse velocityResponse(const Slip& slip, double normalForce, double friction,
                                  int dimension);

/// Collective. Returns B, N×N, N·s/m, with diagonal blocks at the pad nodes. `nodalForce` contains
/// the normal components r_N of the nodal forces, in newtons, [contact node]:
///   B = f r_N (φ/|w| (1 − ττᵀ − nnᵀ) + dφ/d|w| ττᵀ)
/// where f is the coefficient at the swept `friction`. −B is the derivative of the nodal friction
/// forces with respect to the relative velocities.
OwnedMat nodalResponse(const Contact& contact, const std::vector<Slip>& slip,
                       const std::vector<double>& nodalForce, double friction);

/// Collective. Returns B, N×N, N·s/m, positive semidefinite for a constant law. `normalForce`
/// contains the forces R_N ≥ 0 of the gaps, in newtons, [contact node]. If the gap basis is the
/// identity, B is that of nodalResponse(). On tri6 and quad8 faces, where a positive pressure may
/// have negative nodal forces, it is
///   B_ij = ∫ f p (φ/|w| (1 − ττᵀ − nnᵀ) + dφ/d|w| ττᵀ) φᵢ φⱼ dA,
///   f p = Σ (f R_N / ∫φ̃ dA) φ̃,   zero where p = Σ (R_N / ∫φ̃ dA) φ̃ is negative,
/// with w and n interpolated between the nodes.
OwnedMat distributedResponse(const Contact& contact, const std::vector<Slip>& slip,
                             const std::vector<double>& normalForce, double friction);

}  // namespace squeal::contact
