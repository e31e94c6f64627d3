#include "linalg/columns.hpp"

#include <algorithm>

namespace squeal::linalg {

ReadColumns::ReadColumns(BV bv) : bv_(bv) {
  check(BVGetSizes(bv, &rows_, nullptr, &columns_));
  check(BVGetArrayRead(bv, &values_));
}

OwnedBV copiedColumns(Mat like, const PetscScalar* values, PetscInt count) {
  OwnedBV bv;
  OwnedVec layout;
  check(MatCreateVecs(like, layout.out(), nullptr));
  check(BVCreate(PetscObjectComm(reinterpret_cast<PetscObject>(like)), bv.out()));
  check(BVSetSizesFromVec(bv, layout, count));
  check(BVSetType(bv, BVSVEC));
  PetscInt rows = 0;
  PetscScalar* to = nullptr;
  check(VecGetLocalSize(layout, &rows));
  check(BVGetArray(bv, &to));
  std::copy_n(values, static_cast<std::ptrdiff_t>(count) * rows, to);
  check(BVRestoreArray(bv, &to));
  return bv;
}

}  // namespace squeal::linalg
