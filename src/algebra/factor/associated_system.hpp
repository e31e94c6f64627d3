// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The ideal associated system (4.17) of docs/method.md: closed contact, no friction, no rotation.
/// The free modes, the reduced problem and its corrections share it.
#include <memory>
#include <string>

#include "algebra/factor/symmetric_solver.hpp"
#include "base/petsc/owned.hpp"

namespace squeal::factor {

/// Collective. Returns the number of zero rows of a matrix.
PetscInt zeroRows(Mat matrix);

/// The matrices K0 and M0, n×n. K0 is symmetric positive definite. M0 is symmetric positive
/// semidefinite: it has a row of zeros for each unknown without mass. The object also owns a direct
/// solver of K0 (prefix -modes_st_), whose factorisation all stages share.
class AssociatedSystem {
 public:
  /// Collective. Takes ownership of both matrices. Messages refer to K0 by `name`.
  AssociatedSystem(OwnedMat k0, OwnedMat m0, const std::string& name);
  Mat k0() const { return k0_; }
  Mat m0() const { return m0_; }
  PetscInt size() const { return size_; }  ///< n
  MPI_Comm comm() const;
  /// Collective. Returns the direct solver of K0, borrowed. K0 is factorised on first use. An EPS
  /// that uses the solver discards the factor, so call this function before each use. Throws Error
  /// if the factorisation fails.
  KSP solver() const { return solver_->get(); }

 private:
  OwnedMat k0_, m0_;
  PetscInt size_ = 0;
  std::unique_ptr<SymmetricSolver> solver_;
};

}  // namespace squeal::factor
