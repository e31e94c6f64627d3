// SPDX-License-Identifier: BSD-2-Clause
#include "base/system/concatenation.hpp"

#include <numeric>

namespace squeal {
namespace {

/// The type of an entry of this many bytes: counts in bytes might exceed an int.
class EntryType {
 public:
  explicit EntryType(int bytes) {
    MPI_Type_contiguous(bytes, MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
  }
  ~EntryType() { MPI_Type_free(&type_); }
  EntryType(const EntryType&) = delete;
  EntryType& operator=(const EntryType&) = delete;
  operator MPI_Datatype() const { return type_; }  // NOLINT: a borrowed handle

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

}  // namespace

Concatenation::Concatenation(MPI_Comm comm, std::size_t own)
    : comm_(comm), rank_(mpi::rank(comm)), counts_(mpi::size(comm)), begin_(counts_.size()) {
  const int count = own;
  MPI_Allgather(&count, 1, MPI_INT, counts_.data(), 1, MPI_INT, comm);
  std::exclusive_scan(counts_.begin(), counts_.end(), begin_.begin(), 0);
}

void Concatenation::gatherBytes(const void* own, void* all, int bytesPerEntry) const {
  const EntryType entry(bytesPerEntry);
  MPI_Allgatherv(own, counts_[rank_], entry, all, counts_.data(), begin_.data(), entry, comm_);
}

void Concatenation::gatherBytesOnFirst(const void* own, void* all, int bytesPerEntry) const {
  const EntryType entry(bytesPerEntry);
  MPI_Gatherv(own, counts_[rank_], entry, all, counts_.data(), begin_.data(), entry, 0, comm_);
}

}  // namespace squeal
