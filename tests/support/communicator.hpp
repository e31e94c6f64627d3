// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The place of a process among all.
#include <petscsys.h>

#include "base/petsc/check.hpp"

namespace squeal::test {

inline int rankOf(MPI_Comm comm = PETSC_COMM_WORLD) {
  int rank = 0;
  check(MPI_Comm_rank(comm, &rank));
  return rank;
}

inline int sizeOf(MPI_Comm comm = PETSC_COMM_WORLD) {
  int size = 1;
  check(MPI_Comm_size(comm, &size));
  return size;
}

}  // namespace squeal::test
