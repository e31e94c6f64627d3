// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The reduced model of the motion about steady sliding, with the exact conditions of contact and
/// friction at every contact node [M.70, M.71]:
///   u = u_s + V q + Ψ z,   y = j q + z,
///   q̈ + C q̇ + Λ q + K_zqᵀ z + C_zqᵀ ż = jᵀ R*,
///   M_z z̈ + C_z ż + K_z z + K_zq q + C_zq q̇ = R*,
/// where u_s is the steady displacement, V are modes, Ψ are static responses, and R = R_s + R* are
/// the contact forces. The jump y contains the gap and the slips of each node relative to steady
/// sliding. It is the sum of j q, the part that the modes represent, and z, the part that they do
/// not. The unknowns z are called the boundary. Only the scheme of Moreau and Jean uses M_z.
/// Without M_z the boundary is massless, and a contact that closes causes no impulse.
#include <array>
#include <functional>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "base/system/termination.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::march {

using linalg::DenseMatrix;
using mesh::Point;

/// A contact node of the reduced model with its steady state. Its rows in the jump are the gap and
/// one slip along each tangent. The values in these rows are E⁻¹ times the nodal gaps and
/// slips (contact::Contact).
struct Node {
  int interface = 0;
  Point position{};
  Point normal{};                    ///< unit, from disc to pad
  std::array<Point, 2> tangents{};   ///< unit; if the node slides, the first is τ
  double friction = 0;               ///< coefficient of friction in steady sliding
  double lawCoefficient = 0;         ///< factor on the friction law φ; 0: not used at this node
  double frictionSlope = 0;          ///< derivative of `friction` with respect to the speed, s/m
  double sweptFriction = 0;          ///< derivative with respect to the swept coefficient
  double area = 0;                   ///< m²
  double gap = 0;                    ///< steady gap, m; 0 if the node is closed
  double normalForce = 0;            ///< steady R_N, N, ≥ 0
  std::array<double, 2> shear{};     ///< steady friction force on the pad along the tangents, N
  std::array<double, 2> velocity{};  ///< steady relative velocity of the pad, m/s; 0: sticks
  bool pressed() const { return normalForce > 0; }
  bool hasFriction() const { return friction > 0 || lawCoefficient > 0; }
  bool sticks() const { return velocity[0] == 0 && velocity[1] == 0; }
  bool slides() const { return hasFriction() && !sticks(); }
};

struct ReducedModel {
  int dimension = 3;  ///< rows of the jump per node
  std::vector<Node> nodes;
  std::vector<double> stiffness;  ///< Λ, rad²/s², [mode]
  DenseMatrix damping;            ///< C, modes × modes, 1/s
  DenseMatrix jump;               ///< j, rows × modes
  DenseMatrix boundaryMass;       ///< M_z, rows × rows
  DenseMatrix boundaryDamping;    ///< C_z
  DenseMatrix boundaryStiffness;  ///< K_z
  DenseMatrix couplingDamping;    ///< C_zq, rows × modes
  DenseMatrix couplingStiffness;  ///< K_zq
  /// [row] 1 if z has this row as an unknown; 0 for a slip that supports prevent, and for the
  /// slips of nodes without friction
  std::vector<unsigned char> moves;
  /// The friction law φ as a function of the sliding speed, m/s; empty: constant coefficients.
  std::function<double(double)> law;

  PetscInt modes() const { return std::ssize(stiffness); }
  PetscInt rows() const { return std::ssize(nodes) * dimension; }
};

/// Not collective. Returns the coefficient of friction of a node at a sliding speed, m/s.
/// `sweptChange` is added to the swept coefficient of friction of the model.
double coefficient(const ReducedModel& model, const Node& node, double speed, double sweptChange);

/// A motion of the linearised model: e^{st} times these amplitudes.
struct LinearMode {
  Complex s;  ///< 1/s
  std::vector<Complex> q, z;
  std::vector<Complex> jump;   ///< y, [row]
  std::vector<Complex> force;  ///< R*, [row]
};

/// Not collective. Returns an eigenpair of the model linearised about steady sliding, found by
/// Newton's method starting from s. In the linearised model, with the steady relative velocity w
/// and the steady normal force R_N of a node, closed nodes stay closed, and sliding ones obey
///   R_T* = −f R_N* τ − R_N ((f/|w|) (1 − ττᵀ) + (df/d|w|) ττᵀ) ẏ_T   [4.7].
/// Sticking nodes do not slip, and open nodes are free. Throws Error if the method does not
/// converge. Throws Interrupted, only on this rank, once stopRequested() is true.
LinearMode nearestMode(const ReducedModel& model, Complex s,
                       const StopRequested& stopRequested = {});

/// Not collective. Returns the largest time step, in seconds, at which the leapfrog rule is stable
/// if no contact node opens or slips relative to steady sliding (y = 0): 2/ω, where ω is the
/// highest angular frequency in this state.
double stableStep(const ReducedModel& model);
/// Not collective. Returns the largest stable time step, in seconds, with all nodes free. Contact
/// only makes the model stiffer, so a step longer than this is unstable in every state of contact.
double longestStep(const ReducedModel& model);

}  // namespace squeal::march
