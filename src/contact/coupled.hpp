#pragma once
/// These functions make the matrices of the coupled problem, for every matrix X of the bodies
/// [M.11]:
///   L(f)ᵀ X T = Tᵀ X T + f Sᵀ N X T.

#include "contact/contact.hpp"
#include "elasticity/elasticity.hpp"
#include "modes/associated.hpp"

namespace squeal::contact {

/// The projections of one matrix X of the bodies on the unknowns; both are null where X is.
struct Projection {
  OwnedMat matrix;    ///< Tᵀ X T, n×n
  OwnedMat reaction;  ///< N X T, N×n: the normal forces that X exerts, in the rows of the gaps

  explicit operator bool() const { return matrix.get() != nullptr; }
  /// Collective. Returns Sᵀ N X T, n×n, the friction of these normal forces, for the slip rows S.
  OwnedMat friction(Mat slipRows) const;
};

/// Collective. Returns the projections of X, which may be null, by a transformation.
Projection project(const Contact& contact, const Transformation& transformation, Mat x);

/// Collective. Returns X0 + f X1 as a new matrix, a copy of X0 if f is 0 and otherwise unsymmetric.
/// The pattern of X1 must lie within that of X0.
OwnedMat affine(Mat x0, Mat x1, double f);

/// The matrices of the bodies in the unknowns of one active set.
struct Projections {
  Transformation transformation;
  Projection stiffness;          ///< projections of K, prestress included
  Projection mass;               ///< projections of M
  Projection damping;            ///< projections of C
  Projection gyroscopic;         ///< projections of G for the base motions
  Projection rotationStiffness;  ///< projections of K^R for the base motions
};

/// A CoupledSystem is the coupled problem with the contact closed at the active nodes. Without
/// friction and rotation it is the associated system [4.17],
///   K0 = Tᵀ K T,   M0 = Tᵀ M T.
/// The one factorisation of K0 serves the steady problem, the modes and the corrections of this
/// active set.
class CoupledSystem : public modes::AssociatedSystem {
 public:
  /// Collective. Projects the matrices of the bodies. Contact node i is active if closed[i] is set.
  /// `prestress` is added to K, has the pattern of K and is borrowed during this call; it may be
  /// null.
  CoupledSystem(const elasticity::Bodies& bodies, const Contact& contact,
                std::vector<unsigned char> closed, Mat prestress = nullptr);
  const Transformation& transformation() const { return projections_.transformation; }
  const Projections& projections() const { return projections_; }
  /// Returns 1 for each contact node that is active and 0 for the others, [contact node]; borrowed.
  const std::vector<unsigned char>& closed() const { return closed_; }
  /// Returns the number of contact nodes that are not active, over all ranks.
  PetscInt openNodes() const { return openNodes_; }

 private:
  CoupledSystem(Projections projections, std::vector<unsigned char> closed, PetscInt openNodes);
  Projections projections_;
  std::vector<unsigned char> closed_;
  PetscInt openNodes_ = 0;
};

}  // namespace squeal::contact
