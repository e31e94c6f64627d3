// SPDX-License-Identifier: BSD-2-Clause
#include "base/system/mpi.hpp"

#include <algorithm>

namespace squeal::mpi {
namespace {

double reductions = 0;

/// The calls have their names in parentheses: a macro of PETSc, which a precompiled header may
/// define, would count them as well.
void countReduction(MPI_Comm comm) {
  if (size(comm) > 1) ++reductions;
}

Located located(MPI_Comm comm, double value, MPI_Op operation) {
  Located result{value, rank(comm)};
  reduceValues(comm, &result, 1, MPI_DOUBLE_INT, operation);
  return result;
}

}  // namespace

int rank(MPI_Comm comm) {
  int number = 0;
  MPI_Comm_rank(comm, &number);
  return number;
}

int size(MPI_Comm comm) {
  int count = 1;
  MPI_Comm_size(comm, &count);
  return count;
}

double reductionsSoFar() { return reductions; }

void reduceValues(MPI_Comm comm, void* values, std::size_t count, MPI_Datatype type,
                  MPI_Op operation) {
  constexpr std::size_t largest = 1 << 30;  // the count of MPI is an int
  MPI_Aint begin = 0, bytes = 0;
  MPI_Type_get_extent(type, &begin, &bytes);
  auto* at = static_cast<char*>(values);
  do {
    const std::size_t part = std::min(count, largest);
    countReduction(comm);
    (MPI_Allreduce)(MPI_IN_PLACE, at, int(part), type, operation, comm);
    at += part * bytes;
    count -= part;
  } while (count > 0);
}

void sumAlike(MPI_Comm comm, std::span<double> values) {
  reduce<double>(comm, values, MPI_SUM);
  broadcastEntries<double>(comm, values);
}

Located maxLocated(MPI_Comm comm, double value) { return located(comm, value, MPI_MAXLOC); }

Located minLocated(MPI_Comm comm, double value) { return located(comm, value, MPI_MINLOC); }

bool any(MPI_Comm comm, bool value) { return max(comm, int(value)) != 0; }

bool all(MPI_Comm comm, bool value) { return min(comm, int(value)) != 0; }

void broadcastBytes(MPI_Comm comm, void* bytes, std::size_t count, int root) {
  constexpr std::size_t largest = 1 << 30;  // the count of MPI is an int
  auto* at = static_cast<char*>(bytes);
  do {
    const std::size_t part = std::min(count, largest);
    countReduction(comm);
    (MPI_Bcast)(at, int(part), MPI_BYTE, root, comm);
    at += part;
    count -= part;
  } while (count > 0);
}

void broadcast(MPI_Comm comm, std::string& text, int root) {
  std::size_t length = text.size();
  broadcast(comm, length, root);
  text.resize(length);
  broadcastBytes(comm, text.data(), length, root);
}

}  // namespace squeal::mpi
