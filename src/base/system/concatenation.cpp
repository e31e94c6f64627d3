// SPDX-License-Identifier: BSD-2-Clause
#include "base/system/concatenation.hpp"

#include <numeric>

namespace squeal {

Concatenation::Concatenation(MPI_Comm comm, std::size_t own)
    : comm_(comm), rank_(mpi::rank(comm)), counts_(mpi::size(comm)), begin_(counts_.size()) {
  const int count = own;
  MPI_Allgather(&count, 1, MPI_INT, counts_.data(), 1, MPI_INT, comm);
  std::exclusive_scan(counts_.begin(), counts_.end(), begin_.begin(), 0);
}

void Concatenation::gatherBytes(const void* own, void* all, int bytesPerEntry) const {
  MPI_Datatype entry = MPI_DATATYPE_NULL;  // counts in bytes might exceed an int
  MPI_Type_contiguous(bytesPerEntry, MPI_BYTE, &entry);
  MPI_Type_commit(&entry);
  MPI_Allgatherv(own, counts_[rank_], entry, all, counts_.data(), begin_.data(), entry, comm_);
  MPI_Type_free(&entry);
}

}  // namespace squeal
