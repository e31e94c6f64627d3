#pragma once
/// Access to the entries that a vector has on this rank.
#include <petscvec.h>

#include "petsc/check.hpp"

namespace squeal {

/// The entries of a vector on this rank, borrowed during the life of the object, which must end
/// before that of the vector and before the vector is used otherwise. Taking them and giving them
/// back is not collective: a rank may do so on its own.
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

/// Entries to read. Several objects may read one vector at the same time.
using ReadArray = BorrowedArray<const PetscScalar, VecGetArrayRead, VecRestoreArrayRead>;
/// Entries to read and to change.
using WriteArray = BorrowedArray<PetscScalar, VecGetArray, VecRestoreArray>;

}  // namespace squeal
