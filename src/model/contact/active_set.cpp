// SPDX-License-Identifier: BSD-2-Clause
#include "model/contact/active_set.hpp"

#include "base/system/mpi.hpp"

namespace squeal::contact {

bool sameOnAllRanks(MPI_Comm comm, const ActiveSet& a, const ActiveSet& b) {
  return mpi::all(comm, a == b);
}

PetscInt countDifferent(MPI_Comm comm, const Mask& a, const Mask& b) {
  PetscInt count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
  return mpi::sum(comm, count);
}

PetscInt countDifferent(MPI_Comm comm, const ActiveSet& a, const ActiveSet& b) {
  PetscInt count = 0;
  for (std::size_t i = 0; i < a.closed.size(); ++i)
    count += a.closed[i] != b.closed[i] || a.released[i] != b.released[i];
  return mpi::sum(comm, count);
}

void ActiveSetHull::add(const ActiveSet& set) {
  for (std::size_t i = 0; i < set.closed.size(); ++i) {
    anywhere.closed[i] = anywhere.closed[i] || set.closed[i];
    anywhere.released[i] = anywhere.released[i] && set.released[i];
    everywhere.closed[i] = everywhere.closed[i] && set.closed[i];
    everywhere.released[i] = everywhere.released[i] || set.released[i];
  }
}

}  // namespace squeal::contact
