// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Calls of LAPACK routines that need a work array.
#include <petscsys.h>

#include <vector>

namespace squeal::linalg {

/// Calls a routine of LAPACK twice, as
///   call(double* work, PetscBLASInt length),
/// first with length = −1, which returns the required length in work[0], and then with an array of
/// that length. Not collective.
template <class Call>
void callWithWork(const Call& call) {
  double wanted = 0;
  call(&wanted, -1);
  const PetscBLASInt length = wanted;
  std::vector<double> work(length);
  call(work.data(), length);
}

}  // namespace squeal::linalg
