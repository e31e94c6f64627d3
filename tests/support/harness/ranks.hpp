// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Ranks: the number of this one, output of only one, and values of all of them together.
#include <mpi.h>
#include <petscsys.h>

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <numeric>
#include <vector>

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

/// Measured figures, once for all ranks.
[[gnu::format(printf, 1, 2)]] inline void print(const char* format, ...) {
  int rank = 0;
  check(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank != 0) return;
  va_list arguments;
  va_start(arguments, format);
  std::vprintf(format, arguments);
  va_end(arguments);
}

/// Collective. The largest value of all ranks; a NaN of any rank is the result.
inline double largest(double value) {
  double both[] = {std::isnan(value) ? 1.0 : 0.0, std::isnan(value) ? 0.0 : value};
  check(MPI_Allreduce(MPI_IN_PLACE, both, 2, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD));
  return both[0] > 0 ? NAN : both[1];
}

/// Collective. The sum over all ranks.
inline double total(double value) {
  check(MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
  return value;
}

/// Collective. The lists of all ranks, one after the other, on all of them.
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
