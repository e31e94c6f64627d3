#pragma once
/// The matrices of the coupled problem, affine in friction: L(f)ᵀ X T = X0 + f X1 for X = K, M.
#include "contact/contact.hpp"

namespace squeal::contact {

struct CoupledMatrices {
  Transformation transformation;
  OwnedMat k0, k1;  ///< Tᵀ K T (symmetric) and Eᵀ K T, n×n
  OwnedMat m0, m1;  ///< Tᵀ M T and Eᵀ M T, n×n; empty without mass

  /// Collective. X0 + f X1 as a new matrix.
  static OwnedMat affine(Mat x0, Mat x1, double friction);
};

/// Collective. Triple products for one choice of unknown gaps and sliding nodes.
CoupledMatrices couple(const elasticity::Bodies& bodies, const Contact& contact, const std::vector<unsigned char>& gapFree,
                       const std::vector<unsigned char>& slides, bool withMass);

/// The ideal associated system [4.17]: contact closed on the active nodes, no friction, no rotation. K0 is symmetric positive
/// definite; its one factorisation serves the steady problem and the modes of this active set.
class AssociatedSystem {
 public:
  /// Collective. `closed[i]`: contact node i is active. Factorises K0 on first use of solver().
  AssociatedSystem(const elasticity::Bodies& bodies, const Contact& contact, std::vector<unsigned char> closed);
  const CoupledMatrices& matrices() const { return matrices_; }
  const std::vector<unsigned char>& closed() const { return closed_; }
  PetscInt openNodes() const { return openNodes_; }  ///< of all ranks
  PetscInt size() const { return matrices_.transformation.columns; }
  /// Collective. Direct solver for K0 (prefix -modes_st_), factorised.
  KSP solver() const;

 private:
  void factorise() const;
  CoupledMatrices matrices_;
  std::vector<unsigned char> closed_;
  PetscInt openNodes_ = 0;
  mutable OwnedKSP solver_;
};

/// Unused -modes_st_* options are typing errors once this has been configured.
void rejectUnusedSolverOptions();

}  // namespace squeal::contact
