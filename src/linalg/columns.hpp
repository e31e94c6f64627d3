#pragma once
/// Access to the columns of a SLEPc BV as plain arrays.
#include "petsc/owned.hpp"

namespace squeal::linalg {

/// Read access to this rank's rows of a BV of type svec, as one contiguous column-major array of
/// rows() × columns(). The BV is borrowed and locked for reading during the life of the object.
class ReadColumns {
 public:
  explicit ReadColumns(BV bv);
  ~ReadColumns() { BVRestoreArrayRead(bv_, &values_); }
  ReadColumns(const ReadColumns&) = delete;
  ReadColumns& operator=(const ReadColumns&) = delete;
  const PetscScalar* values() const { return values_; }
  PetscInt rows() const { return rows_; }
  PetscInt columns() const { return columns_; }

 private:
  BV bv_;
  PetscInt rows_ = 0, columns_ = 0;
  const PetscScalar* values_ = nullptr;
};

/// Collective. Returns a BV of type svec with `count` columns, whose vectors are laid out like the
/// columns of `like`. The entries are copied from `values`, this rank's rows, column-major.
OwnedBV copiedColumns(Mat like, const PetscScalar* values, PetscInt count);

}  // namespace squeal::linalg
