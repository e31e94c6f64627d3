// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The coupled problem: each matrix X of the bodies, projected on the unknowns that remain under
/// the conditions of contact [M.11],
///   L(f)ᵀ X T = Tᵀ X T + Sᵀ N X T,   S = S_0 + f S_1.
/// T maps the unknowns to nodal displacements; the columns of L are the test vectors. N maps nodal
/// forces to the normal forces at the gaps, which Sᵀ turns into friction forces. The slip rows S_0
/// have fixed coefficients of friction; those of S_1 are multiplied by f, that of the sweep.
#include "algebra/factor/associated_system.hpp"
#include "model/contact/contact.hpp"
#include "model/elasticity/elasticity.hpp"

namespace squeal::contact {

/// The projections of one matrix X of the bodies on the unknowns. Both are null if X is null.
struct Projection {
  OwnedMat matrix;    ///< Tᵀ X T, n×n
  OwnedMat reaction;  ///< N X T: its rows are the normal forces that X exerts at the gaps

  explicit operator bool() const { return matrix.get() != nullptr; }
  /// Collective. Returns Sᵀ N X T, n×n, for the slip rows S: the friction forces due to these
  /// normal forces.
  OwnedMat friction(Mat slipRows) const;
  /// Collective. Returns Tᵀ X T + Sᵀ N X T as a new, unsymmetric matrix; with null slip rows, a
  /// copy of Tᵀ X T.
  OwnedMat tested(Mat slipRows) const;
};

/// Collective. Returns the projections of X by a transformation. X may be null.
Projection project(const Contact& contact, const Transformation& transformation, Mat x);

/// The matrices of the bodies in the unknowns of one active set.
struct Projections {
  Transformation transformation;
  Projection stiffness;          ///< projections of K, including prestress
  Projection mass;               ///< projections of M
  Projection damping;            ///< projections of C
  Projection gyroscopic;         ///< projections of G, at the speed factor 1
  Projection rotationStiffness;  ///< projections of K^R, at the speed factor 1
};

/// The projections with all contact open and all sticking nodes released. The projections for every
/// active set are submatrices of these, since the T of an active set consists of columns of this T.
class OpenProjections {
 public:
  /// Collective. Projects the matrices of the bodies.
  OpenProjections(const elasticity::Bodies& bodies, const Contact& contact);
  /// Collective. Returns the projections of an active set.
  Projections of(const Contact& contact, const ActiveSet& set) const;

 private:
  Projections all_;
};

/// The coupled problem with the contact closed at the active nodes. Without friction and rotation
/// it is the associated system [4.17],
///   K0 = Tᵀ K T,   M0 = Tᵀ M T.
/// One factorisation of K0 serves the steady problem, the modes and the corrections of the basis.
class CoupledSystem : public factor::AssociatedSystem {
 public:
  /// Collective. Projects the matrices of the bodies. A node of a sticking interface can move along
  /// the surface if it is open, or if `set` releases it. `prestress`, which may be null, is added
  /// to K; it must have the pattern of geometricStiffness(). It is borrowed during this call.
  CoupledSystem(const elasticity::Bodies& bodies, const Contact& contact, ActiveSet set,
                Mat prestress = nullptr);
  /// Collective. Takes the projected matrices from `open` instead of computing them; without
  /// prestress.
  CoupledSystem(const OpenProjections& open, const Contact& contact, ActiveSet set);
  const Transformation& transformation() const { return projections_.transformation; }
  const Projections& projections() const { return projections_; }
  /// Returns the active set; borrowed.
  const ActiveSet& activeSet() const { return activeSet_; }
  const Mask& closed() const { return activeSet_.closed; }
  /// Returns the number of contact nodes that are open, over all ranks.
  PetscInt openNodes() const { return openNodes_; }

 private:
  CoupledSystem(Projections projections, ActiveSet set, PetscInt openNodes);
  Projections projections_;
  ActiveSet activeSet_;
  PetscInt openNodes_ = 0;
};

}  // namespace squeal::contact
