// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Lists of all ranks together.
#include <mpi.h>

#include <numeric>
#include <vector>

#include "base/petsc/check.hpp"

namespace squeal::test {

/// Collective. What the ranks have, one after the other, on all of them.
template <class Number>
std::vector<Number> gathered(const std::vector<Number>& mine, MPI_Datatype type) {
  int ranks = 1;
  const int count = static_cast<int>(mine.size());
  check(MPI_Comm_size(PETSC_COMM_WORLD, &ranks));
  std::vector<int> counts(static_cast<std::size_t>(ranks)), offsets(counts.size(), 0);
  check(MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, PETSC_COMM_WORLD));
  std::partial_sum(counts.begin(), counts.end() - 1, offsets.begin() + 1);
  std::vector<Number> all(static_cast<std::size_t>(offsets.back() + counts.back()));
  check(MPI_Allgatherv(mine.data(), count, type, all.data(), counts.data(), offsets.data(), type,
                       PETSC_COMM_WORLD));
  return all;
}

}  // namespace squeal::test
