#pragma once
/// This file makes contact a change of variables, with trial functions T and test functions L(f):
///   u = T x + p u0 + u_g,   L(f) = T + f Nᵀ S   [3.6].
///
/// The variables z hold, at each contact node of the pad, tangential displacements and the gap g in
/// place of the Cartesian displacement; at all other nodes they are the Cartesian displacement:
///   u = A z,   n·u_P = n·u_D + g   [2.13].
/// A selection B drops held components and periodic images from z, so that T = A B.
///
/// On tri6 and quad8 faces the gaps g of the nodes are combined from gaps h that have a row of
/// their own in z, g = E h, so that the shape functions of h have positive integrals [M.12].
///
/// Friction is a product of two matrices with a row per contact node. N gives the normal force from
/// the nodal forces r, and S gives the slip of u = T x, with the jump [u] = u_P − u_D:
///   R_N = N r,   S x = E⁻¹ φ τ·[u].
/// The test functions put the friction force of R_N on the tangential rows:
///   L(f)ᵀ r = Tᵀ r + f Sᵀ N r,
/// that is R_T = −f φ R_N τ on the pad [3.4], and its opposite on the disc. Where interfaces have
/// coefficients of their own, f S stands for S_0 + f S_1: S_0 has the rows of those whose
/// coefficient is fixed, times it, and S_1 those of the swept ones, times their factors [M.56].
#include <string>
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/contact/friction.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/interfaces/nodes.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::contact {

using mesh::Point;

using interfaces::ContactNode;
using interfaces::Role;

/// The sliding of a contact node in steady motion.
struct Slip {
  Point direction{};                    ///< τ = w/|w|; zero where |w| = 0
  double speed = 0;                     ///< |w|, m/s
  double law = 1;                       ///< φ(|w|)
  double slope = 0;                     ///< dφ/d|w|, s/m
  interfaces::Coefficient coefficient;  ///< what φ is multiplied by; zero where nothing slides

  /// Returns the coefficient of friction at the swept one, and its derivative with respect to |w|,
  /// s/m.
  double friction(double swept) const { return coefficient.at(swept) * law; }
  double frictionSlope(double swept) const { return coefficient.at(swept) * slope; }
};

/// The trial functions T for one choice of the gaps that are unknowns.
struct Transformation {
  OwnedMat selection;  ///< B, N×n
  OwnedMat trial;      ///< T = A B, N×n
  /// [contact node] global column of its gap; −1 where it is dropped
  std::vector<PetscInt> gapColumn;
  PetscInt ownedColumns = 0, columns = 0;  ///< columns of this rank, and of all ranks (n)
  /// [unknown of this rank] its row of B on this rank, ascending: dimension times the owned node,
  /// plus the component of z
  std::vector<PetscInt> rows;
};

/// The unknowns of this rank of a system with open contact, by whether one with closed contact has
/// them too. Both lists ascend and count from 0 on each rank.
struct ReleasedUnknowns {
  std::vector<PetscInt> shared, released;
};

/// Returns which unknowns of `open` are those of `closed`, whose unknowns are among them.
ReleasedUnknowns compared(const Transformation& open, const Transformation& closed);

/// The contact of all interfaces: its nodes and its matrices.
struct Contact : interfaces::Interfaces {
  std::vector<std::string> interfaces;  ///< names
  FrictionLaw law;
  OwnedMat periodic;  ///< P, N×N: copies u of primaries to their images; the identity elsewhere
  OwnedMat reaction;  ///< N, N×N: R_N of a contact node from all nodal forces, in the row of its
                      ///< gap; other rows are empty
  OwnedMat jump;  ///< J, N×N: [u] = u_P − u_D in the rows of the contact nodes; others are empty
  OwnedMat convected;   ///< D, N×N, 1/s: (V·∇)u_D at the contact nodes, in their rows, for the
                        ///< base motions; null without convective terms
  OwnedMat kinematics;  ///< A, N×N
  OwnedVec offset;      ///< u0, N entries, m: held displacements and displacements of obstacles
  OwnedVec gapOffset;   ///< u_g, N entries, m: closes the gaps that there are without load
  /// [owned node · dimension + component of z] 1 if it is an unknown; gaps are counted as unknowns
  std::vector<unsigned char> free;
  const mesh::Mesh* mesh = nullptr;  ///< borrowed

  /// Returns the row of z and of N that belongs to the gap of a contact node.
  PetscInt gapRow(const ContactNode& node) const;
  /// Collective. Returns T, in which the gap of contact node i is an unknown if gapFree[i] is set.
  /// A node of a sticking interface does not move along its master unless released[i] is set; an
  /// empty list releases none.
  Transformation transformation(const std::vector<unsigned char>& gapFree,
                                const std::vector<unsigned char>& released = {}) const;
  /// Returns true if the slip is the same at all points of a sweep: there are no convective terms
  /// and the friction law is constant.
  bool slipIsGiven() const { return !convected && law.constant(); }
  /// Collective. Returns the slip, [contact node], at the speed factor v, from the part of
  ///   w = −v (V + D u_D)   [2.15]
  /// in the tangent plane. If `displacement` u is null, or without convective terms, w = −v V.
  std::vector<Slip> slip(double speed, Vec displacement) const;
  /// Collective. Returns the normal components of the nodal forces of contact, E⁻ᵀ R_N, N, from
  /// R_N, N, both [contact node]. On faces whose E is the identity they are the same.
  std::vector<double> nodalForce(const std::vector<double>& normalForce) const;
  /// Collective. Returns the same with R_N left out where closed[contact node] is not set.
  std::vector<double> nodalForce(std::vector<double> normalForce,
                                 const std::vector<unsigned char>& closed) const;
  /// Collective. Returns the gaps at the nodes, E h, m, from the unknown ones, both [contact node].
  std::vector<double> nodalGap(const std::vector<double>& gap) const;
  /// Collective. Returns Eᵀ v of forces v at the nodes, both [contact node].
  std::vector<double> gapForce(const std::vector<double>& nodal) const;
  /// Collective. Returns E⁻¹ v of values v at the nodes, both [contact node].
  std::vector<double> gapCoefficients(const std::vector<double>& nodal) const;
  /// Returns the powers of the swept friction with which interfaces carry friction: 0 where a
  /// coefficient is fixed, 1 where one is swept. The same on all ranks.
  std::vector<int> frictionExponents() const;
  /// Returns true if any interface sticks. The same on all ranks.
  bool hasSticking() const;
  /// Returns true if any interface carries friction at the swept one. The same on all ranks.
  bool hasFriction(double swept) const;
  /// Collective. Returns S_a, N×n, for the power a of the swept friction: E⁻¹ c φ τ·[u] of u = T x,
  /// with c the part of the coefficient that goes with this power, in the rows of the gaps of the
  /// contact nodes with slides[i] set; other rows are empty.
  OwnedMat slipRows(const Transformation& transformation, const std::vector<Slip>& slip,
                    const std::vector<unsigned char>& slides, int exponent) const;
  /// Collective. Returns S_0 + f S_1 at the swept friction f.
  OwnedMat slipRowsAt(const Transformation& transformation, const std::vector<Slip>& slip,
                      const std::vector<unsigned char>& slides, double swept) const;

 private:
  OwnedMat slipRows(const Transformation& transformation, const std::vector<Slip>& slip,
                    const std::vector<unsigned char>& slides,
                    const std::vector<double>& factors) const;
};

/// Collective. Builds normals, slip directions, constraints and all matrices. `ties` are those of
/// ties::findTies(). `mesh` is borrowed by the result. Throws Error for surfaces that do not
/// meet, a bad constraint, a pad that moves, a held component that is not tangential at a contact
/// node, an obstacle face that is not flat, and a body that can move rigidly with the contact
/// closed; the message names body and motion.
Contact build(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
              interfaces::Interfaces ties);

/// Collective. Throws Error if nothing moves along a sliding interface, at any friction: its bodies
/// rest on each other, and what holds or frees them along the surface is another role's matter.
void requireMotion(const Contact& contact);

/// Collective. Throws Error, naming position and options, if a contact node with active[i] set
/// carries friction at the swept one and does not slip: friction has no direction there.
void requireSlip(const Contact& contact, const std::vector<Slip>& slip,
                 const std::vector<unsigned char>& active, double swept);

}  // namespace squeal::contact
