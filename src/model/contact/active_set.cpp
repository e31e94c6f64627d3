// SPDX-License-Identifier: BSD-2-Clause
#include "model/contact/active_set.hpp"

#include "base/system/mpi.hpp"

namespace squeal::contact {

bool sameOnAllRanks(MPI_Comm comm, const ActiveSet& a, const ActiveSet& b) {
  return mpi::all(comm, a == b);
}

}  // namespace squeal::contact
