// SPDX-License-Identifier: BSD-2-Clause
#include "base/system/error.hpp"

#include <cstdio>
#include <cstdlib>

#include "base/system/termination.hpp"

namespace squeal {

void reportDefect(const char* rule, std::source_location where) {
  std::fprintf(stderr, "squeal: error: a defect of the program: %s (%s, %s:%u); please report it\n",
               rule, where.function_name(), where.file_name(), unsigned(where.line()));
  runTerminationHandlers();
  MPI_Abort(MPI_COMM_WORLD, 70);
  std::abort();
}

void failTogether(MPI_Comm comm, const std::string& localMessage) {
  const int ranks = mpi::size(comm);
  const int first = mpi::min(comm, localMessage.empty() ? ranks : mpi::rank(comm));
  if (first == ranks) return;
  std::string message = localMessage;
  mpi::broadcast(comm, message, first);
  throw Error(message);
}

}  // namespace squeal
