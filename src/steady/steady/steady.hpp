// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Steady sliding: equilibrium with unilateral contact and Coulomb friction,
///   g ≥ 0,   R_N ≥ 0,   g R_N = 0   [3.3],   R_T = −f φ R_N τ   [3.4],
/// where g is the gap, R_N and R_T the normal and the friction force, f the coefficient of
/// friction, φ the friction law and τ the sliding direction. On tri6 and quad8 faces, g stands for
/// the gap coefficient h (ContactState). src/README.md explains the other symbols. Numbers in
/// brackets refer to equations in docs/method.md. Nodal vectors have one entry per displacement
/// component of each node. [contact node] marks a list with one entry per contact node of this
/// rank.
#include <string>
#include <vector>

#include "eigen/sweep/parameters.hpp"
#include "model/contact/active_set.hpp"
#include "model/contact/coupled.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/mesh/mesh.hpp"
#include "steady/steady/iterative_refinement.hpp"
#include "steady/steady/sticking.hpp"

namespace squeal::steady {

/// The steady state of one contact node.
struct ContactState {
  double gap = 0;  ///< g = n·(u_P − u_D) plus the initial gap, m
  /// The unknown h ≥ 0 that describes the gap, m. It differs from g only on tri6 and quad8 faces
  /// (gap_basis.hpp).
  double coefficient = 0;
  double normalForce = 0;  ///< R_N in newtons, ≥ 0 in compression
  double pressure = 0;     ///< R_N over the nodal area, Pa
  Point frictionForce{};   ///< R_T on the pad, newtons; where nodes stick, the tangential reaction
};

/// The contact forces of one interface.
struct Resultant {
  std::string interface;
  Point normalForce{}, frictionForce{};  ///< sums over the interface, on the pad, N
  Point moment{};  ///< of both forces on the pad about the origin, N·m (in plane problems, about z)
  /// The smallest coefficient of friction at which all compressed sticking nodes would stick: their
  /// largest |R_T| / R_N. Zero unless the interface sticks.
  double leastFriction = 0;
  Point worst{};  ///< position of the node with the largest ratio, m
  std::optional<double>
      stickingLimit;       ///< coefficient of friction of a sticking interface, if given
  PetscInt overLimit = 0;  ///< sticking nodes with |R_T| / R_N above the limit of the interface
  PetscInt pulled = 0;     ///< those of `overLimit` under tension; no coefficient suffices for them
  PetscInt released = 0;   ///< closed nodes of a sticking interface that slide
  PetscInt returned = 0;   ///< those of `released` that slide in the direction of their
                           ///< friction force, which is inconsistent
  PetscInt unheld = 0;     ///< closed free nodes of a sticking interface (Hold::open)
  /// Magnitude of the sum of the moments of the contact forces on both sides, N·m. It is nonzero if
  /// the meshes do not match and the two surfaces do not coincide.
  double momentDefect = 0;
};

/// The steady state at one point of the sweep.
struct Solution {
  sweep::Parameters at;
  bool converged = false;
  std::string reason;  ///< why SNES, PETSc's nonlinear solver, stopped, or why no solution exists
  /// Set only if no solution was found at this point. The program then followed the solution from
  /// another point towards this one; beyond these parameters it does not exist.
  std::optional<sweep::Parameters> existsTo;
  double tolerance = 0;  ///< relative tolerance of SNES
  int iterations = 0;    ///< Newton steps of SNES; 0 if SNES is not called
  /// Relative residual: the 2-norm of the natural residual (naturalResidual()), divided by the
  /// 2-norm of F at x = 0 [M.15].
  double residual = 0;
  OwnedVec displacement;              ///< u, nodal vector, m
  std::vector<ContactState> contact;  ///< [contact node]
  std::vector<contact::Slip> slip;    ///< [contact node] slip of sliding interfaces
  /// [contact node] 1 if R_N > negligibleForce, or if the interface of the node cannot separate.
  contact::Mask closed;
  Sticking sticking;            ///< which nodes of sticking interfaces are held, free or released
  int revisions = 0;            ///< number of revisions of `sticking` for this state
  double negligibleForce = 0;   ///< smaller contact forces are round-off, N
  PetscInt openNodes = 0;       ///< contact nodes that are not closed, over all ranks
  double smallestPressure = 0;  ///< smallest pressure of all contact nodes, Pa
  std::vector<Resultant> resultants;  ///< [interface]
  /// Each connected part of the mesh has a resultant of contact, support and load forces. This is
  /// the largest magnitude of these resultants, divided by the sum of the magnitudes of all nodal
  /// forces.
  double imbalance = 0;
  /// Number of contact nodes, over all ranks, that are closed in only one of two known solutions at
  /// the same parameters; 0 if no second solution is known.
  PetscInt nodesOfAnother = 0;
};

/// Returns the active set of a steady state.
contact::ActiveSet activeSet(const Solution& solution);

/// The complementarity problem [3.3–3.4, M.13], with u = T x + p u0 + u_g:
///   r = (K + v² K^R) u − b,   b = p b_p + b_0 + v² b_c,
///   F(x) = Tᵀ r + Sᵀ N r,   S = S_0 + f S_1,
///   0 ≤ g ⟂ F_g = R_N ≥ 0 at the gaps,   F = 0 in all other rows.
/// The matrix T maps the unknowns x to displacements, and N extracts normal forces from nodal
/// forces. Here S includes the coefficients of friction: it is the matrix S_0 + f S_1 of
/// contact.hpp, which is f S if all interfaces have the swept coefficient. The factors v and p
/// scale speed and pressure. The loads b have three parts: b_p, which scales with p; b_0, which is
/// constant; and the centrifugal forces b_c, which scale with v². The displacement u_g closes the
/// initial gaps [M.54] and imposes the shortening of the bolts.
///
/// Convective terms arise because the material moves through the mesh, which is fixed in space, and
/// carries its displacement with it. Without them (-motion_convective off, approximation A of
/// Moirot and Nguyen) the problem is linear except for the inequalities. With them, S depends on u
/// through the relative velocity w = −v (V + D u_D), where V is the velocity of the disc or
/// obstacle at v = 1, and D u_D = (V·∇) u_D the convective derivative of its displacement.
///
/// A node of a sticking interface is in one of three states, its *hold*. A held node sticks. A free
/// node (Hold::open) has tangential unknowns and no tangential force. A released node has
/// tangential unknowns and slides; its row in S uses the sticking limit of the interface as the
/// coefficient of friction.
class Problem {
 public:
  /// Collective. Borrows mesh, bodies and contact for the lifetime of the object. All nodes of
  /// sticking interfaces are held.
  Problem(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
          const contact::Contact& contact);
  /// Collective. The same with given holds.
  Problem(const mesh::Mesh& mesh, const elasticity::Bodies& bodies, const contact::Contact& contact,
          Sticking sticking);
  /// Collective. Solves with SNES VI (-steady_snes_*). The initial guess is the solution on the
  /// active set of `system`, computed with its factorisation. At first, the nodes of sticking
  /// interfaces have the holds of this problem; nextHolds() then updates the holds until they no
  /// longer change. `converged` and `reason` report whether a solution was found. Throws Error if
  /// |w| = 0 at a node with friction.
  Solution solve(const sweep::Parameters& at, const contact::CoupledSystem& system) const;

  /// Collective. Sets `result` to F(x), which has one entry per unknown x.
  void residual(const sweep::Parameters& at, Vec x, Vec result) const;
  /// Collective. Returns the exact derivative dF/dx [M.14] as a new matrix with the same pattern at
  /// every x.
  OwnedMat jacobian(const sweep::Parameters& at, Vec x) const;
  /// Collective. Returns the nodal vector u = T x + p u0 + u_g, m.
  OwnedVec displacement(const sweep::Parameters& at, Vec x) const {
    return displacement(transformation_, at, x);
  }
  /// Collective. Returns r = (K + v² K^R) u − b, the nodal forces of supports and contact, newtons.
  OwnedVec forces(const sweep::Parameters& at, Vec displacement) const;
  /// Collective. Throws Error if |w|, computed without convective terms, is 0 at a node with
  /// friction.
  void requireSlip(const sweep::Parameters& at) const;
  /// Collective. Returns the updated holds, or none if they do not change or if the solution has
  /// not converged. Returns none as well, and marks the solution as not converged, if the updated
  /// holds would leave a body under-constrained, if the limit of revisions is reached, or if a node
  /// with friction has a tensile normal force and its interface cannot separate.
  std::optional<Sticking> nextHolds(Solution& solution) const;
  /// Collective. Computes the other members of `solution` from the unknowns x, and rejects the
  /// solution if a check fails. The caller has set `at`, `converged`, `reason`, `tolerance`,
  /// `iterations` and `residual`. `left` is the 2-norm, in newtons, of the natural residual at x
  /// (naturalResidual()).
  void conclude(Vec x, double left, Solution& solution) const;
  /// Collective. Returns the loads b at this point, a nodal vector in newtons.
  OwnedVec load(const sweep::Parameters& at) const;
  /// Collective. Returns (K + v² K^R) u, a nodal vector in newtons.
  OwnedVec springForces(double speed, Vec displacement) const;
  /// Collective. Returns R_N = N r of nodal forces r, [contact node].
  std::vector<double> normalForces(Vec forces) const;
  /// Collective. Returns the numerator of [M.16], an estimate of the round-off error in F, in
  /// newtons:
  ///   ε (‖diag(K) u‖ + ‖b‖).
  /// `loads` b may be null.
  double rounding(Vec displacement, Vec loads) const;

  const mesh::Mesh& mesh() const { return mesh_; }
  const contact::Contact& contact() const { return contact_; }
  /// Returns T. Its unknowns include all gaps, and the tangential displacements of free and
  /// released nodes of sticking interfaces.
  const contact::Transformation& transformation() const { return transformation_; }
  const elasticity::Bodies& bodies() const { return bodies_; }
  /// Returns Tᵀ K T and N K T, where T is transformation(). The first call computes them and is
  /// collective.
  const contact::Projection& stiffness() const;

 private:
  Solution solveFrom(const sweep::Parameters& at, Vec z) const;
  std::string whyUnderConstrained(const Sticking& sticking) const;
  void rejectUnderConstrained(Solution& solution) const;
  std::vector<contact::Slip> slip(double speed, Vec displacement) const;
  OwnedVec displacement(const contact::Transformation& transformation, const sweep::Parameters& at,
                        Vec x) const;
  OwnedVec test(const contact::Transformation& transformation, const contact::Mask& slides,
                const sweep::Parameters& at, Vec forces,
                const std::vector<contact::Slip>& slip) const;
  /// Returns S_0 + f S_1; null without friction.
  OwnedMat slipRows(const contact::Transformation& transformation,
                    const std::vector<contact::Slip>& slip, const contact::Mask& slides,
                    double friction) const;
  double largestDisplacement(const sweep::Parameters& at, Vec x) const;
  OwnedVec closedContact(const sweep::Parameters& at, const contact::CoupledSystem& system) const;
  void recover(Vec x, double noise, Solution& solution) const;
  double imbalance(const Solution& solution, Vec nodalForces,
                   const std::vector<Point>& onPads) const;

  const mesh::Mesh& mesh_;
  const elasticity::Bodies& bodies_;
  const contact::Contact& contact_;
  contact::Mask all_;  // [contact node] 1 for every node
  Sticking sticking_;
  bool anyReleased_ = false;                                   // on any rank
  contact::Transformation transformation_;                     // all gaps unknown
  mutable contact::Projection stiffness_, rotationStiffness_;  // created on first use
  OwnedVec diagonal_;                                          // diagonal of K, a nodal vector
  OwnedMat jumps_, convected_;  // J T and D T of contact::Sliding; empty without convective terms
};

}  // namespace squeal::steady
