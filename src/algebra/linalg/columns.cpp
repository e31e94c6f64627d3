// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/linalg/columns.hpp"
#include "base/petsc/object.hpp"

#include <algorithm>

namespace squeal::linalg {

ReadColumns::ReadColumns(BV bv) : bv_(bv) {
  check(BVGetSizes(bv, &rows_, nullptr, &columns_));
  check(BVGetArrayRead(bv, &values_));
}

OwnedBV copiedColumns(Mat like, const DenseView& columns) {
  OwnedBV bv;
  OwnedVec layout;
  check(MatCreateVecs(like, layout.out(), nullptr));
  check(BVCreate(commOf(like), bv.out()));
  check(BVSetSizesFromVec(bv, layout, columns.columns()));
  check(BVSetType(bv, BVSVEC));
  PetscScalar* to = nullptr;
  check(BVGetArray(bv, &to));
  std::ranges::copy(columns.entries(), to);
  check(BVRestoreArray(bv, &to));
  return bv;
}

}  // namespace squeal::linalg
