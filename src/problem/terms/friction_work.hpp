// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The work of friction on the motion of a mode at each contact node. It shows where friction
/// destabilises the mode.
#include <array>
#include <vector>

#include "algebra/linalg/complexvector.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/sweep/parameters.hpp"
#include "model/contact/contact.hpp"
#include "model/elasticity/elasticity.hpp"
#include "problem/terms/settings.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::terms {

/// The complex amplitudes of a vector in space.
using ComplexPoint = std::array<Complex, 3>;

/// The nodal forces and the energy of a motion u e^{st}.
struct MotionForces {
  /// The nodal forces r* = (s² M + s (c C + v G) + K + v² K^R + K_σ) u, with N = dimension · nodes
  /// entries.
  linalg::ComplexVector forces;
  /// The terms K u, M u and C u, N entries; C u is null without damping.
  linalg::ComplexVector elastic = {}, inertia = {}, damped = {};
  /// The energy E = |s|² uᴴ M u + uᴴ (K + v² K^R + K_σ) u [M.51], four times the mean energy.
  double energy = 0;
};

/// A motion u e^{st} at a point of the sweep. `at`, `u` and `prestress` are borrowed.
struct Motion {
  const sweep::Parameters& at;
  Complex s;
  const linalg::ComplexVector& u;  ///< N entries
  Mat prestress = nullptr;         ///< K_σ of the steady state; null: none
};
/// Collective. Returns the forces and the energy of a motion.
MotionForces motionForces(const elasticity::Bodies& bodies, const Motion& motion);

/// The amplitudes of a motion at the contact.
struct ContactMotion {
  linalg::ComplexVector jump;       ///< jump [u] in the rows of the contact nodes, N entries
  linalg::ComplexVector convected;  ///< D u_D in the same rows; null without convective terms
  /// The normal components E⁻ᵀ R_N* of the nodal forces, [owned contact node], with R_N* = N r* at
  /// closed gaps and R_N* = 0 at open ones.
  std::vector<Complex> nodalForce;
};
/// Collective. Returns the values of a nodal vector at the contact nodes, [owned contact node].
std::vector<ComplexPoint> atPadNodes(const contact::Contact& contact,
                                     const linalg::ComplexVector& u);
/// Collective. Returns the amplitudes at the contact of the motion u with the nodal forces
/// `forces`. closed[k] is 1 for a closed gap, 0 for an open one.
ContactMotion contactMotion(const contact::Contact& contact,
                            const std::vector<unsigned char>& closed,
                            const linalg::ComplexVector& u, const linalg::ComplexVector& forces);

/// The friction data of one point of a sweep.
struct FrictionState {
  sweep::Parameters at;             ///< its `friction` is used only for FrictionForm::pressing
  std::vector<contact::Slip> slip;  ///< [contact node]
  OwnedMat response;                ///< B at this state, N×N
  OwnedMat turning;                 ///< the part of B without the slope of the friction law, N×N
};
/// Collective. Returns the friction data. B is computed from the normal forces `responseForce`,
/// which responseForces() returns.
FrictionState frictionState(const contact::Contact& contact, const sweep::Parameters& at,
                            std::vector<contact::Slip> slip,
                            const std::vector<double>& responseForce);
/// Collective. Returns the friction data of the steady state.
FrictionState frictionState(const contact::Contact& contact, const steady::Solution& solution,
                            const Settings& settings);

/// The form −[w]ᴴ R_T* of a contact node for a test jump [w] has two parts, since [4.7]
///   R_T* = −f φ r_N* τ − B (s [u] − v D u_D).
struct FrictionForm {
  Complex pressing;  ///< from the change of the normal force
  Complex turning;   ///< from the change of the relative velocity
};
/// Collective. Returns the forms of the contact nodes for the jumps `test`. Both lists are [owned
/// contact node].
std::vector<FrictionForm> frictionForms(const contact::Contact& contact, const FrictionState& state,
                                        Complex s, const std::vector<ComplexPoint>& test,
                                        const ContactMotion& motion);

/// Collective. Returns the contribution of friction to the growth rate of the mode, by cause,
/// [contact node]. closed[k] is 1 for a closed gap, 0 for an open one. At open nodes the
/// contribution is zero, except on tri6 and quad8 faces that are partly closed. `force` contains
/// the forces and the energy of the mode.
///
/// The mode u = T x satisfies Tᵀ r* = (J T)ᵀ R_T*. The real part of its product with (s x)ᴴ is,
/// with σ = Re s and E of MotionForces [M.51],
///   σ E + |s|² c uᴴ C u = Σ_k Re((s [u]_k)ᴴ R_T*,k).
/// G is skew-symmetric and does no work. The contribution of node k is [M.52]
///   Re((s [u]_k)ᴴ R_T*,k) / E.
/// The contributions of all nodes add up to σ + |s|² c uᴴ C u / E. The mean energy of the mode is
/// E/4. The work of friction at a node over a cycle is (π / Im s) E times its contribution.
std::vector<pencil::GrowthParts> frictionGrowth(const contact::Contact& contact,
                                                const std::vector<unsigned char>& closed,
                                                const FrictionState& friction, const Motion& mode,
                                                const MotionForces& force);

}  // namespace squeal::terms
