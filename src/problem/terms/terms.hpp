// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The terms of the eigenvalue problem with friction [4.15, 4.16], made from the coupled matrices
/// and the steady state. Numbers in brackets refer to equations in docs/method.md, and
/// src/README.md explains the symbols. X0 = Tᵀ X T for each matrix X of the bodies: K, M, C, G and
/// K^R.
#include "eigen/completeness/friction_factors.hpp"
#include "eigen/pencil/pencil.hpp"
#include "model/contact/coupled.hpp"
#include "problem/terms/settings.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::terms {

/// Collective. Returns the terms that are valid for all parameters: K0, M0, c C0, v G0 and v² K^R0.
/// If S is the same at all points (contact::Contact::slipIsConstant()), the friction terms
/// f^a S_aᵀ N X T are included, for each X, with its factor c or v, and for each power a of the
/// swept friction f that occurs. The arguments may be destroyed after the call.
pencil::Pencil affineTerms(const contact::Contact& contact, const contact::CoupledSystem& system);

/// Collective. Returns the friction terms of affineTerms() for the contact nodes i for which
/// slides[i] is 1; these nodes may be open in `system`. Returns no terms if S differs between
/// points.
std::vector<pencil::Term> slidingTerms(const contact::Contact& contact,
                                       const contact::CoupledSystem& system,
                                       const std::vector<unsigned char>& slides);

/// Collective. Returns the friction terms of affineTerms() as products of thin matrices, for the
/// contact nodes i for which slides[i] is 1. FrictionFactors::rowsOf is not set. If S differs
/// between points, FrictionFactors::missing contains this reason.
completeness::FrictionFactors frictionFactors(const contact::Contact& contact,
                                              const contact::CoupledSystem& system,
                                              const std::vector<unsigned char>& slides);

/// Collective. Returns the terms that depend on the steady state, of three kinds:
/// 1. The friction terms f^a S_aᵀ N X T, if S depends on the deformation or on a friction law that
///    is not constant.
/// 2. Friction damping. In a vibration u, the relative velocity changes by w* = [∂u/∂t] − v D u_D,
///    and the friction force by −B w* [4.7, M.20]. The terms are [M.21], with J and D of
///    contact::Sliding,
///      (J T)ᵀ B (J T) in Z̄, which Moirot and Nguyen call f[A],
///      −v (J T)ᵀ B (D T) in K̄, f[B_T] + f[B_N] there, with convective terms.
/// 3. Tᵀ X T and the friction terms of X = `prestressChange`, the geometric stiffness at the point
///    minus that in `system` (a nodal matrix; null: none).
/// The first two kinds are omitted without friction, and the second also without friction damping.
std::vector<pencil::Term> pointTerms(const contact::Contact& contact,
                                     const contact::CoupledSystem& system,
                                     const steady::Solution& solution, Mat prestressChange,
                                     const Settings& settings);

/// Not collective. Returns the normal forces from which B is computed, [contact node], N: R_N at
/// the `closed` nodes and zero at the others; zero everywhere without friction damping.
std::vector<double> responseForces(const std::vector<unsigned char>& closed,
                                   std::vector<double> normalForce, const Settings& settings);

}  // namespace squeal::terms
