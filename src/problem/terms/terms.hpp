// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The terms of the friction-perturbed problem [4.15, 4.16], from the coupled matrices and the
/// steady state.
#include "eigen/completeness/friction_factors.hpp"
#include "eigen/pencil/pencil.hpp"
#include "model/contact/coupled.hpp"
#include "problem/terms/settings.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::terms {

/// Collective. Returns the terms that hold for all parameters: K0, M0, c C0, v G0, v² K^R0 and, if
/// the slip is the same at all points, the friction f^a S_aᵀ N X T of each of these matrices for
/// all powers a with friction. The arguments may be destroyed after the call.
pencil::Pencil affineTerms(const contact::Contact& contact, const contact::CoupledSystem& system);

/// Collective. Returns the friction terms of affineTerms() for the contact nodes with slides[i]
/// set, which may be open in `system`; none if the slip differs between points.
std::vector<pencil::Term> slidingTerms(const contact::Contact& contact,
                                       const contact::CoupledSystem& system,
                                       const std::vector<unsigned char>& slides);

/// Collective. Returns the factors of the friction terms of affineTerms() for the contact nodes
/// with slides[i] set, without the rows of ranges. They are missing if the slip differs between
/// points.
completeness::FrictionFactors frictionFactors(const contact::Contact& contact,
                                              const contact::CoupledSystem& system,
                                              const std::vector<unsigned char>& slides);

/// Collective. Returns the terms that depend on the steady state. The first is the friction f^a
/// S_aᵀ N X T if the slip depends on the deformation or on a friction law. The second is the change
/// of the friction force with the relative velocity w* = [u_t] − v D u_D, −B w* [4.7]. It gives
/// [M.21]
///   (J T)ᵀ B (J T) in Z̄, the paper's f[A],
///   −v (J T)ᵀ B (D T) in K̄, the paper's f[B_T] + f[B_N], with convective terms.
/// Both are omitted without friction. The last is `prestressChange`, N×N, the change of the
/// geometric stiffness from that in `system`, with its friction; null: none.
std::vector<pencil::Term> pointTerms(const contact::Contact& contact,
                                     const contact::CoupledSystem& system,
                                     const steady::Solution& solution, Mat prestressChange,
                                     const Settings& settings);

/// Not collective. Returns the normal forces for B, [contact node], N: R_N at the `closed`
/// nodes, zero at the others and without friction damping.
std::vector<double> responseForces(const std::vector<unsigned char>& closed,
                                   std::vector<double> normalForce, const Settings& settings);

}  // namespace squeal::terms
