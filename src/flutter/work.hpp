#pragma once
/// The motion of a mode at the contact does the work of friction, which shows the part of the
/// contact that feeds the mode.
#include <array>
#include <vector>

#include "contact/contact.hpp"
#include "elasticity/elasticity.hpp"
#include "linalg/complexvector.hpp"
#include "steady/steady.hpp"
#include "sweep/parameters.hpp"

namespace squeal::flutter {

/// The complex amplitudes of a vector in space.
using ComplexPoint = std::array<Complex, 3>;

/// The nodal forces and the energy of a motion u e^{st}.
struct MotionForces {
  /// The nodal forces r* = (s² M + s (c C + v G) + K + v² K^R + K_σ) u, N entries.
  linalg::ComplexVector forces;
  /// The energy E = |s|² uᴴ M u + uᴴ (K + v² K^R + K_σ) u [M.51], four times the mean energy.
  double energy = 0;
};

/// Collective. Returns the forces and the energy of the motion u, N entries. `prestress` is K_σ of
/// the steady state; it may be null.
MotionForces motionForces(const elasticity::Bodies& bodies, const sweep::Parameters& at, Complex s,
                          const linalg::ComplexVector& u, Mat prestress);

/// The amplitudes of a motion at the contact nodes, [owned contact node].
struct ContactMotion {
  std::vector<ComplexPoint> jump;       ///< [u]
  std::vector<ComplexPoint> convected;  ///< D u_D; zero without convective terms
  std::vector<Complex> normalForce;     ///< R_N* = N r*
};
/// Collective. Returns the jumps [u] at the contact nodes, [owned contact node], of u, N entries.
std::vector<ComplexPoint> contactJump(const contact::Contact& contact,
                                      const linalg::ComplexVector& u);
/// Collective. Returns the amplitudes of the motion u with the nodal forces `forces`.
ContactMotion contactMotion(const contact::Contact& contact, const linalg::ComplexVector& u,
                            const linalg::ComplexVector& forces);

/// The data of friction at one point of a sweep.
struct FrictionState {
  sweep::Parameters at;
  std::vector<contact::Slip> slip;  ///< [owned contact node]
  /// The normal forces that enter B, N, [owned contact node]: responseForces().
  std::vector<double> responseForce;
};

/// The form −[w]ᴴ R_T* of a contact node for a test jump [w] has two parts, with [4.7]
///   R_T* = −f φ R_N* τ − B (s [u] − v D u_D).
struct FrictionForm {
  Complex pressing;  ///< part with the change of the normal force
  Complex turning;   ///< part with the change of the relative velocity
};
/// Not collective. Returns the form of the owned contact node k for the test jump `test`.
FrictionForm frictionForm(const contact::Contact& contact, const FrictionState& state, Complex s,
                          const ComplexPoint& test, const ContactMotion& motion, std::size_t k);

/// Collective. Returns the contribution of friction at each contact node to the growth rate of the
/// mode u e^{st}, 1/s, [owned contact node]. Where it is positive, friction feeds the mode; at open
/// nodes it is zero.
///
/// The mode u = T x satisfies Tᵀ r* = (J T)ᵀ R_T*. The real part of its product with (s x)ᴴ is,
/// with σ = Re s and E of MotionForces [M.51],
///   σ E + |s|² c uᴴ C u = Σ_k Re((s [u]_k)ᴴ R_T*,k).
/// G is skew and does no work. The value of node k is [M.52]
///   Re((s [u]_k)ᴴ R_T*,k) / E.
/// All values add up to σ + |s|² c uᴴ C u / E. The mean energy is E/4, and the work over a cycle is
/// (π / Im s) E times the value.
std::vector<double> frictionWork(const contact::Contact& contact, const elasticity::Bodies& bodies,
                                 const steady::Solution& solution, const sweep::Parameters& at,
                                 Complex s, const linalg::ComplexVector& u, Mat prestress);

/// Collective. Returns the data of friction from the steady state.
FrictionState frictionState(const contact::Contact& contact, const steady::Solution& solution);

}  // namespace squeal::flutter
