// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Access to the entries of a vector on this rank.
#include <petscvec.h>

#include "base/petsc/check.hpp"

namespace squeal {

/// The entries of a vector on this rank. The object borrows the vector, and must be destroyed
/// before the vector is destroyed or used in any other way. A rank may construct a ReadArray
/// independently of the other ranks. All ranks must construct a WriteArray together, because PETSc
/// caches the norms of a vector and discards them only on ranks that construct a WriteArray.
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

/// Read access. Several objects may read one vector at the same time.
using ReadArray = BorrowedArray<const PetscScalar, VecGetArrayRead, VecRestoreArrayRead>;
/// Read and write access.
using WriteArray = BorrowedArray<PetscScalar, VecGetArray, VecRestoreArray>;

}  // namespace squeal
