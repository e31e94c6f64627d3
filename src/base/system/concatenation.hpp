// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Concatenates the parts of a distributed list on every rank, or on rank 0.
#include <mpi.h>

#include <span>
#include <type_traits>
#include <vector>

#include "base/system/mpi.hpp"

namespace squeal {

/// The position of each rank's part in the concatenated list, in which the parts are ordered by
/// rank.
class Concatenation {
 public:
  /// Collective. `own` is the number of entries of this rank.
  Concatenation(MPI_Comm comm, std::size_t own);
  /// Returns the number of entries of all ranks.
  int size() const { return begin_.back() + counts_.back(); }
  /// Returns the index of the first entry of this rank.
  int ownBegin() const { return begin_[rank_]; }
  /// Collective. Sets the size() entries of `all` from the entries of each rank.
  template <class Entry>
  void gather(std::span<const Entry> own, std::span<Entry> all) const {
    static_assert(std::is_trivially_copyable_v<Entry>);
    gatherBytes(own.data(), all.data(), sizeof(Entry));
  }
  /// Collective. Returns the entries of all ranks.
  template <class Entry>
  std::vector<Entry> gathered(const std::vector<Entry>& own) const {
    std::vector<Entry> all(size());
    gather<Entry>(own, all);
    return all;
  }

  /// Collective. Does the same for entries of `count` doubles each, which are sent in one message.
  void gather(const double* own, double* all, int count) const {
    gatherBytes(own, all, count * static_cast<int>(sizeof(double)));
  }

  /// Collective. Returns the entries of all ranks on rank 0, and none on the others.
  template <class Entry>
  std::vector<Entry> gatheredOnFirst(std::span<const Entry> own) const {
    static_assert(std::is_trivially_copyable_v<Entry>);
    std::vector<Entry> all(rank_ == 0 ? size() : 0);
    gatherBytesOnFirst(own.data(), all.data(), sizeof(Entry));
    return all;
  }

 private:
  void gatherBytes(const void* own, void* all, int bytesPerEntry) const;
  void gatherBytesOnFirst(const void* own, void* all, int bytesPerEntry) const;
  MPI_Comm comm_;
  int rank_;
  std::vector<int> counts_, begin_;  // [rank]
};

/// Collective. Returns the entries of all ranks in the order of the ranks.
template <class Entry>
std::vector<Entry> concatenated(MPI_Comm comm, const std::vector<Entry>& own) {
  return Concatenation(comm, own.size()).gathered(own);
}

/// Collective. Returns the entries of all ranks in the order of the ranks on rank 0, and none on
/// the others.
template <class Entry>
std::vector<Entry> concatenatedOnFirst(MPI_Comm comm, std::span<const Entry> own) {
  return Concatenation(comm, own.size()).gatheredOnFirst(own);
}

}  // namespace squeal
