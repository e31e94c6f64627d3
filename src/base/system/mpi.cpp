// SPDX-License-Identifier: BSD-2-Clause
#include "base/system/mpi.hpp"

#include <algorithm>

namespace squeal::mpi {

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

bool any(MPI_Comm comm, bool value) { return max(comm, int(value)) != 0; }

bool all(MPI_Comm comm, bool value) { return min(comm, int(value)) != 0; }

void broadcastBytes(MPI_Comm comm, void* bytes, std::size_t count, int root) {
  constexpr std::size_t largest = 1 << 30;  // the count of MPI is an int
  auto* at = static_cast<char*>(bytes);
  do {
    const std::size_t part = std::min(count, largest);
    MPI_Bcast(at, int(part), MPI_BYTE, root, comm);
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
