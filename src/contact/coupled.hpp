#pragma once
/// The matrices of the coupled problem: L(f)ᵀ X T = Tᵀ X T + f Sᵀ N X T for every matrix X of the
/// bodies.
#include <memory>

#include "contact/contact.hpp"
#include "elasticity/elasticity.hpp"
#include "linalg/symmetric_solver.hpp"

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

/// The ideal associated system [4.17]: contact closed on the active nodes, no friction, no
/// rotation. K0 is symmetric positive definite; its one factorisation serves the steady problem,
/// the modes and the corrections of this active set.
class AssociatedSystem {
 public:
  /// Collective. `closed[i]`: contact node i is active. `prestress` (may be null) is added to K.
  /// Factorises K0 on first use of solver().
  AssociatedSystem(const elasticity::Bodies& bodies, const Contact& contact,
                   std::vector<unsigned char> closed, Mat prestress = nullptr);
  const Transformation& transformation() const { return transformation_; }
  const Projection& stiffness() const { return stiffness_; }    ///< of K
  const Projection& mass() const { return mass_; }              ///< of M
  const Projection& damping() const { return damping_; }        ///< of C
  const Projection& gyroscopic() const { return gyroscopic_; }  ///< of G at the base motions
  const Projection& rotationStiffness() const {
    return rotationStiffness_;
  }  ///< of K^R at the base motions
  Mat k0() const { return stiffness_.matrix; }
  Mat m0() const { return mass_.matrix; }
  const std::vector<unsigned char>& closed() const { return closed_; }
  PetscInt openNodes() const { return openNodes_; }  ///< of all ranks
  PetscInt size() const { return transformation_.columns; }
  /// Collective. Direct solver for K0 (prefix -modes_st_), factorised.
  KSP solver() const { return solver_->get(); }

 private:
  Transformation transformation_;
  Projection stiffness_, mass_, damping_, gyroscopic_, rotationStiffness_;
  std::vector<unsigned char> closed_;
  PetscInt openNodes_ = 0;
  std::unique_ptr<linalg::SymmetricSolver> solver_;
};

}  // namespace squeal::contact
