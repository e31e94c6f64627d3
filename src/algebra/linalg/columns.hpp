// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Access to the columns of a SLEPc BV as matrices.
#include "algebra/linalg/dense.hpp"
#include "base/petsc/owned.hpp"

namespace squeal::linalg {

/// Read access to this rank's rows of a BV of type svec. The BV is borrowed and locked for reading
/// during the lifetime of the object.
class ReadColumns {
 public:
  explicit ReadColumns(BV bv);
  ~ReadColumns() { BVRestoreArrayRead(bv_, &values_); }
  ReadColumns(const ReadColumns&) = delete;
  ReadColumns& operator=(const ReadColumns&) = delete;
  DenseView view() const { return {values_, rows_, columns_}; }

 private:
  BV bv_;
  PetscInt rows_ = 0, columns_ = 0;
  const PetscScalar* values_ = nullptr;
};

/// Collective. Returns a BV of type svec with a copy of `columns`, which contain this rank's rows.
/// The BV is laid out like the columns of `like`.
OwnedBV copiedColumns(Mat like, const DenseView& columns);

}  // namespace squeal::linalg
