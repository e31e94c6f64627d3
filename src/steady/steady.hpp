#pragma once
/// Steady sliding (paper, section 3): gap ≥ 0, R_N ≥ 0, gap·R_N = 0, R_T = −f R_N τ, equilibrium elsewhere.
#include <optional>
#include <string>
#include <vector>

#include "contact/coupled.hpp"

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
  double friction = 0;
  bool converged = false;
  std::string reason;  ///< SNES converged reason, or why there is no solution
  int iterations = 0;
  OwnedVec displacement;              ///< u, N entries, m
  std::vector<ContactState> contact;  ///< [owned contact node]
  std::vector<unsigned char> closed;  ///< [owned contact node] active: closed and pressed
  PetscInt openNodes = 0;             ///< of all ranks
  double smallestPressure = 0;        ///< over all contact nodes, Pa
  std::vector<Resultant> resultants;  ///< [interface]
  double imbalance =
      0;  ///< worst |contact + supports + load| of a connected part over the sum of the magnitudes of all nodal forces
};

/// The complementarity problem F(x) = L(f)ᵀ (K (T x + u0) − b), gaps g ≥ 0 ⟂ F_g = R_N ≥ 0, F = 0 elsewhere.
class Problem {
 public:
  /// Collective. Borrows mesh, bodies and contact for its life.
  Problem(const mesh::Mesh& mesh, const elasticity::Bodies& bodies, const contact::Contact& contact);
  /// Collective. Starts from the solution with the active set of `system` held, by its factorisation, then SNES VI
  /// (-steady_snes_*).
  Solution solve(double friction, const contact::AssociatedSystem& system) const;

 private:
  OwnedVec guess(double friction, const contact::AssociatedSystem& system) const;
  void complementarity(OwnedVec& x, Solution& solution) const;
  void recover(Vec x, Solution& solution) const;
  double imbalance(const Solution& solution, Vec nodalForces) const;

  const mesh::Mesh& mesh_;
  const elasticity::Bodies& bodies_;
  const contact::Contact& contact_;
  contact::CoupledMatrices matrices_;  // all gaps unknown, all nodes sliding
  OwnedVec residual0_;                 // K u0 − b, N
};

/// Collective. Pressure p with ∫ φ_i p dA = R_N,i (the consistent mass of the pad faces), [owned contact node], Pa.
std::vector<double> consistentPressure(const mesh::Mesh& mesh, const contact::Contact& contact,
                                       const std::vector<ContactState>& states);

}  // namespace squeal::steady
