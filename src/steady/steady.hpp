#pragma once
/// Steady sliding (paper, section 3): gap ≥ 0, R_N ≥ 0, gap·R_N = 0, R_T = −f φ R_N τ, equilibrium
/// elsewhere.
#include <optional>
#include <string>
#include <vector>

#include "contact/coupled.hpp"
#include "elasticity/elasticity.hpp"
#include "mesh/mesh.hpp"
#include "steady/refinement.hpp"
#include "sweep/parameters.hpp"

namespace squeal::steady {

using mesh::Point;

struct ContactState {
  double gap = 0;          ///< m
  double normalForce = 0;  ///< R_N, N, ≥ 0 in compression
  double pressure = 0;     ///< Pa: R_N over nodal area, or consistent with R_N on faces whose nodal
                           ///< areas are not positive
  Point frictionForce{};   ///< R_T on the pad, N
};

struct Resultant {
  std::string interface;
  Point normalForce{}, frictionForce{};  ///< sums over the interface, on the pad, N
};

struct Solution {
  sweep::Parameters at;
  bool converged = false;
  std::string reason;  ///< SNES converged reason, or why there is no solution
  int iterations = 0;
  /// 2-norm of what is left of the equations, over that without displacements
  double residual = 0;
  OwnedVec displacement;              ///< u, N entries, m
  std::vector<ContactState> contact;  ///< [owned contact node]
  std::vector<contact::Slip> slip;    ///< [owned contact node] sliding in this state
  std::vector<unsigned char> closed;  ///< [owned contact node] active: closed and pressed
  PetscInt openNodes = 0;             ///< of all ranks
  double smallestPressure = 0;        ///< over all contact nodes, Pa
  std::vector<Resultant> resultants;  ///< [interface]
  double imbalance = 0;  ///< worst |contact + supports + load| of a connected part over the sum of
                         ///< the magnitudes of all nodal forces
};

/// What changes the steady state: per unit of a parameter.
struct Cause {
  /// Dr of the nodal forces r = (K + v² K^R) u − b at fixed u, N entries; null: none
  Vec force = nullptr;
  Vec held = nullptr;   ///< du0 of the held displacements; null: none
  double friction = 0;  ///< df
  double speed = 0;     ///< dv, as it enters the friction law
};

/// First-order change of the steady state while the active set stays.
struct Change {
  OwnedVec displacement;            ///< du, N entries
  std::vector<double> normalForce;  ///< dR_N, [owned contact node]
};

/// The complementarity problem [3.3–3.4]: with u = T x + p u0 and the nodal forces r = (K + v² K^R)
/// u − b, b = p × pressures + v² × centrifugal forces,
///   F(x) = Tᵀ r + f Sᵀ N r, gaps g ≥ 0 ⟂ F_g = R_N ≥ 0, F = 0 elsewhere.
/// Linear under approximation A; with convective terms the slip rows S follow w = −v (V + D u_D).
class Problem {
 public:
  /// Collective. Borrows mesh, bodies and contact for its life.
  Problem(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
          const contact::Contact& contact);
  /// Collective. Starts from the solution with the active set of `system` held, by its
  /// factorisation, then SNES VI
  /// (-steady_snes_*). Error: |w| = 0 at a node that carries friction.
  Solution solve(const sweep::Parameters& at, const contact::CoupledSystem& system) const;

  /// Collective. The change dx of the converged `solution` with dF = 0 on the active set of
  /// `system`: GMRES, preconditioned by the factorised K0. Error: not converged.
  Change change(const Solution& solution, const contact::CoupledSystem& system,
                const Cause& cause) const;

  /// Collective. F(x), n entries.
  void residual(const sweep::Parameters& at, Vec x, Vec f) const;
  /// Collective. dF/dx, exact, n×n, as a new matrix with the same pattern at every x.
  OwnedMat jacobian(const sweep::Parameters& at, Vec x) const;
  /// Collective. u = T x + p u0.
  OwnedVec displacement(const sweep::Parameters& at, Vec x) const {
    return displacement(transformation_, at, x);
  }

 private:
  OwnedVec springForces(double speed, Vec displacement) const;
  OwnedVec load(const sweep::Parameters& at) const;
  OwnedVec displacement(const contact::Transformation& transformation, const sweep::Parameters& at,
                        Vec x) const;
  OwnedVec forces(const sweep::Parameters& at, Vec displacement) const;
  std::vector<double> normalForces(Vec forces) const;
  OwnedVec test(const contact::Transformation& transformation,
                const std::vector<unsigned char>& slides, const sweep::Parameters& at, Vec forces,
                const std::vector<contact::Slip>& slip) const;
  double rounding(Vec displacement, Vec loads) const;
  double naturalResidual(const sweep::Parameters& at, Vec x) const;
  double largestDisplacement(const sweep::Parameters& at, Vec x) const;
  OwnedVec closedContact(const sweep::Parameters& at, const contact::CoupledSystem& system,
                         Refinement& refinement) const;
  double complementarity(OwnedVec& x, Solution& solution) const;
  void recover(Vec x, double noise, Solution& solution) const;
  double imbalance(const Solution& solution, Vec nodalForces) const;

  const mesh::Mesh& mesh_;
  const elasticity::Bodies& bodies_;
  const contact::Contact& contact_;
  std::vector<unsigned char> all_;          // [contact node] 1
  contact::Transformation transformation_;  // all gaps unknown
  contact::Projection stiffness_, rotationStiffness_;
  OwnedVec diagonal_;           // of K, N entries
  OwnedMat jumps_, convected_;  // J T and D T, N×n; empty without convective terms
};

/// Collective. Pressure p with ∫ φ_i p dA = R_N,i (the consistent mass of the pad faces), [owned
/// contact node], Pa.
std::vector<double> consistentPressure(const mesh::Mesh& mesh, const contact::Contact& contact,
                                       const std::vector<double>& normalForce);

}  // namespace squeal::steady
