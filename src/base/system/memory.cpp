// SPDX-License-Identifier: BSD-2-Clause
#include "base/system/memory.hpp"

#include <cstdio>

#include "base/system/mpi.hpp"
#include "base/system/process_memory.hpp"
#include "base/system/termination.hpp"

namespace squeal {

double memoryFreeOnNode(MPI_Comm comm, double& needed) {
  MPI_Comm node = MPI_COMM_NULL;
  MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
  needed = mpi::sum(node, needed);
  MPI_Comm_free(&node);
  return availableMemory();
}

void outOfMemory() {
  std::fprintf(stderr, "squeal: error: rank %d is out of memory: %s\n", mpi::rank(MPI_COMM_WORLD),
               lessMemory);
  abortRun();
}

}  // namespace squeal
