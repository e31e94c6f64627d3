// SPDX-License-Identifier: BSD-2-Clause
#include "base/checkpoint/archive.hpp"

#include <algorithm>

#include "base/petsc/arrays.hpp"

namespace squeal::checkpoint {

void Archive::vector(OwnedVec& values) {
  bool has = static_cast<bool>(values);
  own(has);
  if (!has) {
    if (reads()) values = {};
    return;
  }
  std::vector<double> entries;
  PetscInt blockSize = 1;
  if (!reads()) {
    check(VecGetBlockSize(values, &blockSize));
    const ReadArray array(values);
    entries.assign(array.begin(), array.end());
  }
  own(blockSize, entries);
  if (!reads()) return;
  check(VecCreate(comm_, values.out()));
  check(VecSetSizes(values, std::ssize(entries), PETSC_DETERMINE));
  check(VecSetBlockSize(values, blockSize));
  check(VecSetType(values, VECSTANDARD));
  std::ranges::copy(entries, WriteArray(values).begin());
}

}  // namespace squeal::checkpoint
