#pragma once
/// A mode as the contact sees it, and the work of friction in it: which part of the contact feeds
/// the mode.
#include <array>
#include <complex>
#include <vector>

#include "contact/contact.hpp"
#include "elasticity/elasticity.hpp"
#include "linalg/complexvector.hpp"
#include "steady/steady.hpp"
#include "sweep/parameters.hpp"

namespace squeal::flutter {

/// Complex amplitudes of a vector in space.
using ComplexPoint = std::array<std::complex<double>, 3>;

/// The nodal forces r* = (s² M + s (c C + v G) + K + v² K^R + K_σ) u of a motion u e^{st}, c the
/// damping factor.
struct MotionForces {
  linalg::ComplexVector forces;
  double energy = 0;  ///< |s|² uᴴ M u + uᴴ (K + v² K^R + K_σ) u: four times its mean energy
};
/// Collective. `prestress`: K_σ of the steady state, may be null.
MotionForces motionForces(const elasticity::Bodies& bodies, const sweep::Parameters& at,
                          std::complex<double> s, const linalg::ComplexVector& u, Mat prestress);

/// Amplitudes at the contact nodes, [owned contact node].
struct ContactMotion {
  std::vector<ComplexPoint> jump;                 ///< [u]
  std::vector<ComplexPoint> convected;            ///< D u_D; zero without convective terms
  std::vector<std::complex<double>> normalForce;  ///< R_N* = N r*
};
/// Collective.
std::vector<ComplexPoint> contactJump(const contact::Contact& contact,
                                      const linalg::ComplexVector& u);
ContactMotion contactMotion(const contact::Contact& contact, const linalg::ComplexVector& u,
                            const linalg::ComplexVector& forces);

/// How friction answers at one point of a sweep, f apart where it presses and where it turns.
struct FrictionState {
  sweep::Parameters at;
  std::vector<contact::Slip> slip;  ///< [owned contact node]
  /// R_N in the answer to the relative velocity; zero without friction damping
  std::vector<double> responseForce;
};

/// −[w]ᴴ R_T* of contact node k for test jumps [w], with R_T* = −f φ R_N* τ − B (s [u] − v D u_D)
/// [4.7], in two parts.
struct FrictionForm {
  std::complex<double> pressing;  ///< by the change of the normal force
  std::complex<double> turning;   ///< by the change of the relative velocity
};
FrictionForm frictionForm(const contact::Contact& contact, const FrictionState& state,
                          std::complex<double> s, const ComplexPoint& test,
                          const ContactMotion& motion, std::size_t k);

/// Collective. What friction at each contact node adds to the growth rate of the mode u e^{st},
/// 1/s; positive feeds it.
///   T x = u satisfies Tᵀ r* = (J T)ᵀ R_T*. Times (s x)ᴴ, real part, with σ = Re s:
///     σ (|s|² uᴴMu + uᴴKu) + |s|² uᴴCu = Σ_k Re((s [u]_k)ᴴ R_T*,k),
///   where G (skew) does no work. A quarter of the first bracket is the mean energy E, half of the
///   sum the mean power of friction on the slip velocity: d/dt E = 2 σ E = power − dissipation. The
///   value of node k is its part of the sum over the bracket, so that all nodes together make σ +
///   |s|² uᴴCu / bracket; the work over a cycle is W_k = (4π/Im s) E × the value.
std::vector<double> frictionWork(const contact::Contact& contact, const elasticity::Bodies& bodies,
                                 const steady::Solution& solution, const sweep::Parameters& at,
                                 std::complex<double> s, const linalg::ComplexVector& u,
                                 Mat prestress);

/// Collective. From the steady state.
FrictionState frictionState(const contact::Contact& contact, const steady::Solution& solution);

}  // namespace squeal::flutter
