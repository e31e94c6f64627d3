#pragma once
/// This file gives access to the entries that a vector has on this rank.
#include <petscvec.h>

#include "base/petsc/check.hpp"

namespace squeal {

/// A BorrowedArray gives access to the entries of a vector on this rank. The vector is borrowed
/// during the life of the object, which must end before the vector is used otherwise or destroyed.
/// A rank may read on its own. All ranks have to make a WriteArray together: PETSc keeps norms of a
/// vector, and drops them only on the ranks that wrote.
template <class Value, PetscErrorCode (*take)(Vec, Value**),
          PetscErrorCode (*giveBack)(Vec, Value**)>
class BorrowedArray {
 public:
  explicit BorrowedArray(Vec vector) : vector_(vector) {
    check(VecGetLocalSize(vector, &size_));
    check(take(vector, &data_));
  }
  ~BorrowedArray() { giveBack(vector_, &data_); }
  BorrowedArray(const BorrowedArray&) = delete;
  BorrowedArray& operator=(const BorrowedArray&) = delete;
  Value* data() const { return data_; }
  PetscInt size() const { return size_; }
  Value* begin() const { return data_; }
  Value* end() const { return data_ + size_; }
  Value& operator[](PetscInt i) const { return data_[i]; }

 private:
  Vec vector_;
  PetscInt size_ = 0;
  Value* data_ = nullptr;
};

/// A ReadArray gives entries to read. Several of them may read one vector at the same time.
using ReadArray = BorrowedArray<const PetscScalar, VecGetArrayRead, VecRestoreArrayRead>;
/// A WriteArray gives entries to read and to change.
using WriteArray = BorrowedArray<PetscScalar, VecGetArray, VecRestoreArray>;

}  // namespace squeal
