// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Contact as a change of variables, with trial functions T and test functions L(f):
///   u = T x + p u0 + u_g,   L(f) = T + f Nᵀ S   [3.6].
///
/// At each contact node of the pad, the variables z are the tangential displacements and the gap g
/// instead of the Cartesian displacement; at all other nodes they are the Cartesian displacement:
///   u = A z,   n·u_P = n·u_D + g   [2.13].
/// A selection B removes held components and periodic images from z: T = A B.
///
/// On tri6 and quad8 faces, z contains gap coefficients h instead of the nodal gaps g = E h,
/// because the shape functions of h have positive integrals [M.12].
///
/// Friction is a product of two matrices with a row per contact node. N gives the normal force from
/// the nodal forces r, and S gives the slip of u = T x, with the jump [u] = u_P − u_D:
///   R_N = N r,   S x = E⁻¹ φ τ·[u].
/// The test functions add the friction force due to R_N to the tangential rows:
///   L(f)ᵀ r = Tᵀ r + f Sᵀ N r,
/// that is R_T = −f φ R_N τ on the pad [3.4], and its opposite on the disc. If interfaces have
/// their own coefficients, S_0 + f S_1 replaces f S. S_0 holds the rows of interfaces with a fixed
/// coefficient, scaled by it; S_1 holds the rows of interfaces with the swept friction, scaled by
/// their factors [M.56].
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

/// The sliding of a contact node in steady motion.
struct Slip {
  Point direction{};                    ///< τ = w/|w|; zero where |w| = 0
  double speed = 0;                     ///< |w|, m/s
  double law = 1;                       ///< φ(|w|)
  double slope = 0;                     ///< dφ/d|w|, s/m
  interfaces::Coefficient coefficient;  ///< factor of φ; zero without sliding

  /// Return the coefficient of friction of the node for the value `swept` of the sweep, and its
  /// derivative with respect to |w|, s/m.
  double friction(double swept) const { return coefficient.at(swept) * law; }
  double frictionSlope(double swept) const { return coefficient.at(swept) * slope; }
};

/// The contact of all interfaces: its nodes and its matrices.
struct Contact {
  const mesh::Mesh* mesh = nullptr;  ///< borrowed
  interfaces::Interfaces interfaces;
  FrictionLaw law;
  OwnedMat periodic;  ///< P, N×N: copies u of primaries to their images; the identity elsewhere
  Kinematics kinematics;
  Sliding sliding;

  /// Returns the row of z and of N that belongs to the gap of a contact node.
  PetscInt gapRow(const ContactNode& node) const;
  /// Collective. Returns T of an active set (transformationOf()).
  Transformation transformation(const ActiveSet& set) const;
  /// Returns true if the slip is the same at all points of a sweep, that is, without convective
  /// terms and with a constant friction law.
  bool slipIsConstant() const { return !sliding.convected && law.constant(); }
  /// Collective. Returns the slip, [contact node], at the speed factor v, from the part of
  ///   w = −v (V + D u_D)   [2.15]
  /// in the tangent plane. If `displacement` u is null, or without convective terms, w = −v V.
  std::vector<Slip> slip(double speed, Vec displacement) const;
  /// Collective. Converts normal forces R_N to the normal components of the nodal contact forces,
  /// E⁻ᵀ R_N; both in newtons, [contact node]. On faces whose E is the identity they are equal.
  std::vector<double> nodalForce(const std::vector<double>& normalForce) const;
  /// Collective. Returns the same without R_N of the nodes where closed[contact node] is not set.
  std::vector<double> nodalForce(std::vector<double> normalForce, const Mask& closed) const;
  /// Collective. Returns the gaps at the nodes, E h, m, from the gap unknowns, both [contact node].
  std::vector<double> nodalGap(const std::vector<double>& gap) const;
  /// Collective. Returns Eᵀ v of forces v at the nodes, both [contact node].
  std::vector<double> gapForce(const std::vector<double>& nodal) const;
  /// Collective. Returns E⁻¹ v of values v at the nodes, both [contact node].
  std::vector<double> gapCoefficients(const std::vector<double>& nodal) const;
  /// Returns the exponents with which the swept friction enters the coefficients of the interfaces:
  /// 0 for a fixed coefficient, 1 for a swept one. The same on all ranks.
  std::vector<int> frictionExponents() const;
  /// Returns true if any interface sticks. The same on all ranks.
  bool hasSticking() const;
  /// Returns true if any interface has friction at `swept`. The same on all ranks.
  bool hasFriction(double swept) const;
  /// Collective. Returns S_a (N×n) for a = `exponent`. The gap row of each contact node i with
  /// slides[i] set gives E⁻¹ c φ τ·[u] of u = T x, where c is the part of the coefficient with the
  /// power a of the swept friction. All other rows are empty.
  OwnedMat slipRows(const Transformation& transformation, const std::vector<Slip>& slip,
                    const Mask& slides, int exponent) const;
  /// Collective. Returns S_0 + f S_1 at the swept friction f.
  OwnedMat slipRowsAt(const Transformation& transformation, const std::vector<Slip>& slip,
                      const Mask& slides, double swept) const;

 private:
  OwnedMat slipRows(const Transformation& transformation, const std::vector<Slip>& slip,
                    const Mask& slides, const std::vector<double>& factors) const;
};

}  // namespace squeal::contact
