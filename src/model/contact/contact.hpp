// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Contact as a change of variables, with trial functions T and test functions L(f):
///   u = T x + p u0 + u_g,   L(f) = T + f Nᵀ S   [3.6].
/// Here u are the nodal displacements, x the unknowns, and f the coefficient of friction. u0 are
/// the prescribed displacements; the factor p scales both u0 and the hydraulic loads. u_g closes
/// the initial gaps and imposes the shortening of the bolts. N and S are explained below.
/// src/README.md lists all symbols. Numbers in brackets refer to equations in docs/method.md. Lists
/// marked [contact node] have one entry per contact node of this rank. Nodal vectors have one entry
/// per displacement component of each node, and nodal matrices one row and one column per entry of
/// a nodal vector.
///
/// The vector z has new nodal variables: the tangential displacements and the gap g at contact
/// nodes, and the Cartesian components of the displacement at all other nodes. Contact nodes belong
/// to the slave side; in this comment it is the pad (P), and the other side is the disc (D). A is
/// the matrix of this change of variables, and n the unit normal from disc to pad:
///   u = A z,   n·u_P = n·u_D + g   [2.13].
/// The selection matrix B removes the following from z: supported components, periodic images,
/// components of tied nodes, closed gaps, and the tangential components of sticking nodes. Then T =
/// A B. Equation [2.13] holds without initial gaps. With u_g in u [3.6], n·u_P − n·u_D equals g
/// minus the initial gap [M.54].
///
/// On faces with six or eight nodes (tri6, quad8), z contains gap coefficients h instead of the
/// nodal gaps g = E h [M.12]. Under a uniform pressure, the forces conjugate to h are positive at
/// all nodes; those conjugate to g are not. gap_basis.hpp defines E.
///
/// Friction enters through two matrices, N and S. Only the rows of the gaps of contact nodes have
/// entries. N extracts the normal forces from the nodal forces r. S maps the unknowns x to E⁻¹ φ
/// τ·[u], where [u] = u_P − u_D is the jump between pad and disc, τ the sliding direction, and φ
/// the friction law. E⁻¹ converts values at the nodes to coefficients, as it converts g to h:
///   R_N = N r,   S x = E⁻¹ φ τ·[u],   u = T x.
/// The test functions add the friction force due to R_N to the tangential rows:
///   L(f)ᵀ r = Tᵀ r + f Sᵀ N r.
/// This force is −f φ τ E⁻ᵀ R_N on the pad ([3.4] if E = 1); the disc receives the opposite force.
/// If interfaces have their own coefficients, S_0 + f S_1 replaces f S [M.56]. S_0 has the rows of
/// interfaces with a fixed coefficient, multiplied by this coefficient. S_1 has the rows of the
/// other interfaces, multiplied by their factor on the swept friction f.
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/contact/active_set.hpp"
#include "model/contact/friction.hpp"
#include "model/contact/kinematics.hpp"
#include "model/contact/sliding.hpp"
#include "model/contact/transformation.hpp"
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::contact {

using interfaces::ContactNode;
using interfaces::Role;

/// The sliding velocity of a contact node in steady motion, and its friction.
struct Slip {
  Point direction{};  ///< τ = w/|w|, w the relative velocity of the pad; zero where |w| = 0
  double speed = 0;   ///< |w|, m/s
  double law = 1;     ///< friction law φ(|w|)
  double slope = 0;   ///< dφ/d|w|, s/m
  interfaces::Coefficient coefficient;  ///< of friction, without φ; zero if the node does not slide

  /// friction() returns the coefficient of friction of the node, including φ, for the swept
  /// coefficient `swept`. frictionSlope() returns its derivative with respect to |w|, s/m.
  double friction(double swept) const { return coefficient.at(swept) * law; }
  double frictionSlope(double swept) const { return coefficient.at(swept) * slope; }
};

/// The contact of all interfaces: its nodes and its matrices.
struct Contact {
  const mesh::Mesh* mesh = nullptr;  ///< borrowed
  interfaces::Interfaces interfaces;
  FrictionLaw law;
  OwnedMat periodic;  ///< nodal matrix: copies the displacement of a node to its periodic images
  Kinematics kinematics;
  Sliding sliding;

  /// Returns the row of z and of N that belongs to the gap of a contact node.
  PetscInt gapRow(const ContactNode& node) const;
  /// Collective. Returns T of an active set (transformationOf()).
  Transformation transformation(const ActiveSet& set) const;
  /// Returns true if S depends only on the active set, that is, without convective terms and with a
  /// constant friction law.
  bool slipIsConstant() const { return !sliding.convected && law.constant(); }
  /// Collective. Returns the sliding velocities, [contact node], at the speed factor v (`speed`).
  /// Let V be the velocity of the disc or obstacle at v = 1. The displacement u_D of the disc adds
  /// its convective derivative D u_D = (V·∇) u_D to V. The relative velocity is
  ///   w = −v (V + D u_D)   [2.15],
  /// projected onto the tangent plane. Without convective terms, or if u (`displacement`) is null,
  /// D u_D is zero.
  std::vector<Slip> slip(double speed, Vec displacement) const;
  /// Collective. Returns the normal components E⁻ᵀ R_N of the forces at the nodes, given the forces
  /// R_N conjugate to the gap coefficients h. Both lists are [contact node], in newtons. The two
  /// lists are equal on faces whose E is the identity.
  std::vector<double> nodalForce(const std::vector<double>& normalForce) const;
  /// Collective. Does the same with R_N set to 0 at the nodes that are not closed.
  std::vector<double> nodalForce(std::vector<double> normalForce, const Mask& closed) const;
  /// Collective. Returns the gaps E h at the nodes, given the gap coefficients h. Both lists are
  /// [contact node], in metres.
  std::vector<double> nodalGap(const std::vector<double>& gap) const;
  /// Collective. Returns Eᵀ q, given the normal forces q at the nodes. Both lists are
  /// [contact node].
  std::vector<double> gapForce(const std::vector<double>& nodal) const;
  /// Collective. Returns E⁻¹ g, given the gaps g at the nodes. Both lists are [contact node].
  std::vector<double> gapCoefficients(const std::vector<double>& nodal) const;
  /// Collective. A soft layer has a layer node above each node of its face (mesh::LayerNode), and
  /// the layer node carries the gap. Returns the nodal forces, with the force on each layer node
  /// added to that on the node below it. In this sum the internal forces of the layer cancel, so
  /// the result is the contact force on the face.
  OwnedVec movedFromLayers(Vec forces) const;
  /// Returns the exponents of the swept friction that occur in the coefficients of the interfaces:
  /// the list contains 0 if any coefficient is fixed, and 1 if any is swept. The same on all ranks.
  std::vector<int> frictionExponents() const;
  /// Returns true if any interface sticks. The same on all ranks.
  bool hasSticking() const;
  /// Returns true if any interface has friction at `swept`. The same on all ranks.
  bool hasFriction(double swept) const;
  /// Collective. Returns S_a, where a = `exponent` is 0 or 1. S_a has one row per entry of a nodal
  /// vector and one column per unknown x. Only the gaps of contact nodes whose flag in `slides` is
  /// set have nonempty rows, with S_a x = E⁻¹ c φ τ·[u] and u = T x. If a = 0, c is the fixed
  /// coefficient of the node; if a = 1, its factor on the swept friction. c = 0 if the node has no
  /// such value.
  OwnedMat slipRows(const Transformation& transformation, const std::vector<Slip>& slip,
                    const Mask& slides, int exponent) const;
  /// Collective. Returns S_0 + f S_1 at the swept friction f.
  OwnedMat slipRowsAt(const Transformation& transformation, const std::vector<Slip>& slip,
                      const Mask& slides, double swept) const;
  /// Collective. Returns the matrix Φ such that S_0 + f S_1 = Φ J T at the swept friction f. J maps
  /// displacements to jumps (sliding.hpp). Φ has a row and a column per entry of a nodal vector.
  OwnedMat slipOfJumpsAt(const std::vector<Slip>& slip, const Mask& slides, double swept) const;

 private:
  OwnedMat slipOfJumps(const std::vector<Slip>& slip, const Mask& slides,
                       const std::vector<double>& factors) const;
  OwnedMat slipRows(const Transformation& transformation, const std::vector<Slip>& slip,
                    const Mask& slides, const std::vector<double>& factors) const;
};

}  // namespace squeal::contact
