#pragma once
/// Steady sliding (paper, section 3): gap ≥ 0, R_N ≥ 0, gap·R_N = 0, R_T = −f φ R_N τ, equilibrium elsewhere.
#include <optional>
#include <string>
#include <vector>

#include "contact/coupled.hpp"
#include "parameters.hpp"

namespace squeal::steady {

using mesh::Point;

struct ContactState {
  double gap = 0;          ///< m
  double normalForce = 0;  ///< R_N, N, ≥ 0 in compression
  double pressure = 0;     ///< Pa: R_N over nodal area, or consistent with R_N on faces whose nodal areas are not positive
  Point frictionForce{};   ///< R_T on the pad, N
};

struct Resultant {
  std::string interface;
  Point normalForce{}, frictionForce{};  ///< sums over the interface, on the pad, N
};

struct Solution {
  Parameters at;
  bool converged = false;
  std::string reason;  ///< SNES converged reason, or why there is no solution
  int iterations = 0;
  OwnedVec displacement;              ///< u, N entries, m
  std::vector<ContactState> contact;  ///< [owned contact node]
  std::vector<contact::Slip> slip;    ///< [owned contact node] sliding in this state
  std::vector<unsigned char> closed;  ///< [owned contact node] active: closed and pressed
  PetscInt openNodes = 0;             ///< of all ranks
  double smallestPressure = 0;        ///< over all contact nodes, Pa
  std::vector<Resultant> resultants;  ///< [interface]
  double imbalance =
      0;  ///< worst |contact + supports + load| of a connected part over the sum of the magnitudes of all nodal forces
};

/// The complementarity problem [3.3–3.4]: with u = T x + p u0 and the nodal forces r = (K + v² K^R) u − b, b = p × pressures + v² ×
/// centrifugal forces,
///   F(x) = Tᵀ r + f Sᵀ N r, gaps g ≥ 0 ⟂ F_g = R_N ≥ 0, F = 0 elsewhere.
/// Linear under approximation A; with convective terms the slip rows S follow w = −v (V + D u_D).
class Problem {
 public:
  /// Collective. Borrows mesh, bodies and contact for its life.
  Problem(const mesh::Mesh& mesh, const elasticity::Bodies& bodies, const contact::Contact& contact);
  /// Collective. Starts from the solution with the active set of `system` held, by its factorisation, then SNES VI
  /// (-steady_snes_*). Error: |w| = 0 at a node that carries friction.
  Solution solve(const Parameters& at, const contact::AssociatedSystem& system) const;

  /// Collective. F(x), n entries.
  void residual(const Parameters& at, Vec x, Vec f) const;
  /// Collective. dF/dx, exact, n×n, as a new matrix with the same pattern at every x.
  OwnedMat jacobian(const Parameters& at, Vec x) const;
  /// Collective. u = T x + p u0.
  OwnedVec displacement(const Parameters& at, Vec x) const { return displacement(transformation_, at, x); }

 private:
  OwnedVec load(const Parameters& at) const;
  OwnedVec displacement(const contact::Transformation& transformation, const Parameters& at, Vec x) const;
  OwnedVec forces(const Parameters& at, Vec displacement) const;
  std::vector<double> normalForces(Vec forces) const;
  OwnedVec test(const contact::Transformation& transformation, const std::vector<unsigned char>& slides, const Parameters& at,
                Vec forces, const std::vector<contact::Slip>& slip) const;
  OwnedVec guess(const Parameters& at, const contact::AssociatedSystem& system, double& rest) const;
  void complementarity(OwnedVec& x, Solution& solution) const;
  void recover(Vec x, Solution& solution) const;
  double imbalance(const Solution& solution, Vec nodalForces) const;

  const mesh::Mesh& mesh_;
  const elasticity::Bodies& bodies_;
  const contact::Contact& contact_;
  std::vector<unsigned char> all_;          // [contact node] 1
  contact::Transformation transformation_;  // all gaps unknown
  contact::Projection stiffness_, rotationStiffness_;
  OwnedMat jumps_, convected_;  // J T and D T, N×n; empty without convective terms
};

/// Collective. Pressure p with ∫ φ_i p dA = R_N,i (the consistent mass of the pad faces), [owned contact node], Pa.
std::vector<double> consistentPressure(const mesh::Mesh& mesh, const contact::Contact& contact,
                                       const std::vector<ContactState>& states);

}  // namespace squeal::steady
