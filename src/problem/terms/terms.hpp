// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The terms of the eigenvalue problem with friction [4.15, 4.16], made from the coupled matrices
/// and the steady state.
#include "eigen/completeness/friction_factors.hpp"
#include "eigen/pencil/pencil.hpp"
#include "model/contact/coupled.hpp"
#include "problem/terms/settings.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::terms {

/// Collective. Returns the terms that are valid for all parameters: K0, M0, c C0, v G0, v² K^R0
/// and, if the slip is the same at all points, the friction terms f^a S_aᵀ N X T. X is each of the
/// matrices K, M, C, G, K^R, and a is each power of the swept friction that occurs. The arguments
/// may be destroyed after the call.
pencil::Pencil affineTerms(const contact::Contact& contact, const contact::CoupledSystem& system);

/// Collective. Returns the friction terms of affineTerms() for the contact nodes i for which
/// slides[i] is 1; these may be open in `system`. Returns no terms if the slip differs between
/// points.
std::vector<pencil::Term> slidingTerms(const contact::Contact& contact,
                                       const contact::CoupledSystem& system,
                                       const std::vector<unsigned char>& slides);

/// Collective. Returns the factors of the friction terms of affineTerms() for the contact nodes i
/// for which slides[i] is 1. FrictionFactors::rowsOf is not set. If the slip differs between
/// points, FrictionFactors::missing contains this reason.
completeness::FrictionFactors frictionFactors(const contact::Contact& contact,
                                              const contact::CoupledSystem& system,
                                              const std::vector<unsigned char>& slides);

/// Collective. Returns the terms that depend on the steady state. The first are the friction terms
/// f^a S_aᵀ N X T, if the slip depends on the deformation or on a friction law. The second are
/// those of −B w*, the change of the friction force with the relative velocity w* = [u_t] − v D u_D
/// [4.7]. They are [M.21]
///   (J T)ᵀ B (J T) in Z̄, the paper's f[A],
///   −v (J T)ᵀ B (D T) in K̄, the paper's f[B_T] + f[B_N], with convective terms.
/// Without friction both are omitted. The last are those of `prestressChange`, the difference
/// between the geometric stiffness of the point and that in `system` (N×N; null: none), and of its
/// friction.
std::vector<pencil::Term> pointTerms(const contact::Contact& contact,
                                     const contact::CoupledSystem& system,
                                     const steady::Solution& solution, Mat prestressChange,
                                     const Settings& settings);

/// Not collective. Returns the normal forces from which B is computed, [contact node], N: R_N at
/// the `closed` nodes and zero at the others; zero everywhere without friction damping.
std::vector<double> responseForces(const std::vector<unsigned char>& closed,
                                   std::vector<double> normalForce, const Settings& settings);

}  // namespace squeal::terms
