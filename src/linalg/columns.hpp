#pragma once
/// The columns of a BV as plain arrays.
#include "petsc/owned.hpp"

namespace squeal::linalg {

/// The local rows of a BV of type svec for the life of the object: column-major, contiguous.
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

/// Collective. A BV of type svec for vectors like those of `like`, with these columns: this rank's
/// rows, column-major.
OwnedBV copiedColumns(Mat like, const PetscScalar* values, PetscInt count);

}  // namespace squeal::linalg
