#pragma once
/// The matrices of the coupled problem: L(f)ᵀ X T = Tᵀ X T + f Sᵀ N X T for every matrix X of the
/// bodies.
#include <memory>

#include "contact/contact.hpp"
#include "elasticity/elasticity.hpp"
#include "modes/associated.hpp"

namespace squeal::contact {

/// One matrix X of the bodies in the unknowns; both empty where X is.
struct Projection {
  OwnedMat matrix;    ///< Tᵀ X T, n×n
  OwnedMat reaction;  ///< N X T, N×n: normal forces that X exerts, in the rows of the gaps

  explicit operator bool() const { return static_cast<bool>(matrix); }
  /// Collective. Sᵀ N X T, n×n: the friction of these normal forces, for the slip rows S.
  OwnedMat friction(Mat slipRows) const;
};

/// Collective. Projections of X (null: empty ones) by a transformation.
Projection project(const Contact& contact, const Transformation& transformation, Mat x);

/// Collective. X0 + f X1 as a new unsymmetric matrix, X1 within the pattern of X0.
OwnedMat affine(Mat x0, Mat x1, double f);

/// The matrices of the bodies in the unknowns of one active set.
struct Projections {
  Transformation transformation;
  Projection stiffness;          ///< of K, prestress included
  Projection mass;               ///< of M
  Projection damping;            ///< of C
  Projection gyroscopic;         ///< of G at the base motions
  Projection rotationStiffness;  ///< of K^R at the base motions
};

/// The coupled problem with contact closed on the active nodes. Without friction and rotation it is
/// the associated system [4.17], whose K0 and M0 are those of K and M; its one factorisation serves
/// the steady problem, the modes and the corrections of this active set.
class CoupledSystem : public modes::AssociatedSystem {
 public:
  /// Collective. `closed[i]`: contact node i is active. `prestress` (may be null) is added to K.
  CoupledSystem(const elasticity::Bodies& bodies, const Contact& contact,
                std::vector<unsigned char> closed, Mat prestress = nullptr);
  const Transformation& transformation() const { return projections_.transformation; }
  const Projections& projections() const { return projections_; }
  /// [contact node] 1 if it is active.
  const std::vector<unsigned char>& closed() const { return closed_; }
  PetscInt openNodes() const { return openNodes_; }  ///< of all ranks

 private:
  CoupledSystem(Projections projections, std::vector<unsigned char> closed, PetscInt openNodes);
  Projections projections_;
  std::vector<unsigned char> closed_;
  PetscInt openNodes_ = 0;
};

}  // namespace squeal::contact
