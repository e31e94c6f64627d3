#pragma once
/// The terms of the friction-perturbed problem [4.15–4.16], from the coupled matrices and the
/// steady state.
#include "contact/coupled.hpp"
#include "modes/modes.hpp"
#include "pencil/pencil.hpp"
#include "steady/steady.hpp"

namespace squeal::flutter {

/// Collective. What holds at all parameters: K0, M0, c C0 with the damping factor c, v G0, v² K^R0,
/// and, where all points slide alike, the friction of the normal forces that each of these matrices
/// exerts. Borrows nothing.
pencil::Pencil affineTerms(const contact::Contact& contact, const contact::CoupledSystem& system);

/// Collective. What depends on the steady state: the friction of the normal forces where the slip
/// follows the deformation; the answer −B w* of the friction force to the relative velocity w* =
/// [u_t] − v D u_D [4.7], which gives Z̄ the term (J T)ᵀ B (J T), the paper's f[A], and with
/// convective terms K̄ the term −v (J T)ᵀ B (D T), its f[B_T], f[B_N]; and the change of the
/// geometric stiffness (null: none) from that in `system`. Without `-flutter_friction_damping`,
/// R_T* = −f φ R_N* τ alone.
std::vector<pencil::Term> pointTerms(const contact::Contact& contact,
                                     const contact::CoupledSystem& system,
                                     const steady::Solution& solution, Mat prestressChange);

/// `-flutter_friction_damping`.
bool frictionDampingWanted();
/// Collective. The normal forces that enter the answer to the relative velocity, [owned contact
/// node]: R_N of the `closed` nodes, on tri6 and quad8 faces the pressure on a positive share of
/// the faces; zero without `-flutter_friction_damping`. Linear in R_N.
std::vector<double> responseForces(const contact::Contact& contact,
                                   const std::vector<unsigned char>& closed,
                                   std::vector<double> normalForce);

/// Collective. Modal damping [Caughey]: c Σ 2 ζ_i ω_i (M0 φ_i)(M0 φ_i)ᵀ with the ratios of
/// `-flutter_modal_damping`; empty if there are none. A matrix that can only be multiplied.
std::vector<pencil::Term> modalDamping(const modes::Modes& modes, Mat mass);
/// `-flutter_modal_damping` is given.
bool modalDampingWanted();

}  // namespace squeal::flutter
