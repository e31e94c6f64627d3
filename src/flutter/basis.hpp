#pragma once
/// A growing basis of the reduced problem, orthonormal in the mass M0.
#include <vector>

#include "flutter/dense.hpp"
#include "petsc/owned.hpp"

namespace squeal::flutter {

class Basis {
 public:
  /// Collective. Copies the M0-orthonormal columns of `start`. Borrows `mass`.
  Basis(BV start, Mat mass);
  BV columns() const { return columns_; }  ///< n × size(), type svec
  PetscInt size() const { return size_; }
  /// Collective. Adds what is new in the first `count` columns of `block` (overwritten): combinations of its columns that are
  /// dependent to within `dependent` are dropped. Returns the number of columns added.
  PetscInt add(BV block, PetscInt count, double dependent = 1e-6);

 private:
  void orthogonalise(BV block, PetscInt count);
  static void normalise(BV block, PetscInt count);
  DenseMatrix gram(BV block, PetscInt count) const;
  Mat mass_;
  PetscInt size_ = 0;
  OwnedBV columns_;
};

/// Collective. A BV of `columns` columns laid out like `like`, type svec.
OwnedBV columnsLike(BV like, PetscInt columns);

}  // namespace squeal::flutter
