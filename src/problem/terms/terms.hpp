// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The terms of the eigenvalue problem with friction [4.15, 4.16], made from the coupled matrices
/// and the steady state. Numbers in brackets refer to equations in docs/method.md, and
/// src/README.md explains the symbols. X0 = Tᵀ X T for each matrix X of the bodies: K, M, C, G and
/// K^R.
#include "eigen/pencil/friction_factors.hpp"
#include "eigen/pencil/pencil.hpp"
#include "model/contact/coupled.hpp"
#include "problem/terms/settings.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::terms {

/// Collective. Returns the terms that are valid for all parameters: K0, M0, c C0, v G0
/// and v² K^R0, where c and v are the factors on damping and speed. If S is the same at all points
/// (contact::Contact::slipIsConstant()), the friction terms f^a S_aᵀ N X T are included for each X,
/// with the factor of X0 above and for each exponent a of contact::Contact::frictionExponents().
/// The arguments may be destroyed after the call.
pencil::Pencil affineTerms(const contact::Contact& contact, const contact::CoupledSystem& system);

/// Collective. Returns the friction terms of affineTerms() for the contact nodes i for which
/// slides[i] is 1; these nodes may be open in `system`. Returns no terms if S differs between
/// points.
std::vector<pencil::Term> slidingTerms(const contact::Contact& contact,
                                       const contact::CoupledSystem& system,
                                       const std::vector<unsigned char>& slides);

/// Collective. Returns the friction terms of affineTerms() as products of thin matrices, for the
/// contact nodes i for which slides[i] is 1. If S differs between points, FrictionFactors::missing
/// contains this reason.
pencil::FrictionFactors frictionFactors(const contact::Contact& contact,
                                        const contact::CoupledSystem& system,
                                        const std::vector<unsigned char>& slides);

/// Collective. Returns the factors that the friction terms of all points share, for the contact
/// nodes i for which slides[i] is 1. They belong to the friction terms of affineTerms() and to the
/// first two kinds of pointTerms(). JumpFactors::jumps is J T and JumpFactors::convected is D T, in
/// the rows of these nodes, or, on tri6 and quad8 faces, of all contact nodes.
pencil::JumpFactors jumpFactors(const contact::Contact& contact,
                                const contact::CoupledSystem& system,
                                const std::vector<unsigned char>& slides);
/// Collective. Returns Φ and B at a point for the same nodes. Throws Error if friction damping acts
/// on nodes without rows in JumpFactors::jumps.
pencil::PointFactors pointFactors(const contact::Contact& contact, const steady::Solution& solution,
                                  const std::vector<unsigned char>& slides,
                                  const Settings& settings);

/// Collective. Returns the terms that depend on the steady state, of three kinds:
/// 1. The friction terms f^a S_aᵀ N X T, if S depends on the deformation or on a friction law that
///    is not constant.
/// 2. Friction damping. In a vibration u, the relative velocity changes by w* = [∂u/∂t] − v D u_D,
///    and the friction force by −B w* [4.7, M.20]. With J and D of contact::Sliding, the terms
///    are, by equation M.21,
///      (J T)ᵀ B (J T), a damping matrix, which Moirot and Nguyen write as f times their matrix A;
///      −v (J T)ᵀ B (D T), a stiffness matrix, only with convective terms: f times the sum of their
///      matrices B_T and B_N.
/// 3. Tᵀ X T and the friction terms of X = `prestressChange`, a nodal matrix: the geometric
///    stiffness at the point minus that contained in `system`. Omitted if it is null.
/// The first two kinds are omitted without friction, and the second also without friction damping.
std::vector<pencil::Term> pointTerms(const contact::Contact& contact,
                                     const contact::CoupledSystem& system,
                                     const steady::Solution& solution, Mat prestressChange,
                                     const Settings& settings);

/// Returns true if pointTerms() may return terms at this friction; `prestressed`: the geometric
/// stiffness depends on the point.
bool hasPointTerms(const contact::Contact& contact, double friction, bool prestressed,
                   const Settings& settings);

/// Not collective. Returns the normal forces, in newtons, from which B is computed, one per
/// contact node of this rank: R_N at the `closed` nodes, zero at the others. All are zero without
/// friction damping.
std::vector<double> responseForces(const std::vector<unsigned char>& closed,
                                   std::vector<double> normalForce, const Settings& settings);

}  // namespace squeal::terms
