// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A part of the state of a run, to be written to or read from a checkpoint.
#include <mpi.h>

#include <vector>

#include "base/petsc/check.hpp"
#include "base/petsc/owned.hpp"
#include "base/system/stream.hpp"

namespace squeal::checkpoint {

/// Message if a checkpoint entry does not contain the expected values.
inline constexpr const char* damaged =
    "an entry of the checkpoint is damaged; without -resume the run starts from scratch";

/// Stores the values that all ranks share, once, and each rank's own values. An archive is read by
/// the same calls, in the same order, as those that wrote it.
class Archive {
 public:
  /// Makes an empty archive to write to.
  explicit Archive(MPI_Comm comm) : comm_(comm) {}
  /// Takes the bytes that another archive has written, in order to read them. The common part is
  /// the same on all ranks.
  Archive(MPI_Comm comm, std::vector<char> commonBytes, std::vector<char> ownBytes)
      : common(std::move(commonBytes), damaged), own(std::move(ownBytes), damaged), comm_(comm) {}
  bool reads() const { return own.reads(); }
  MPI_Comm comm() const { return comm_; }
  /// Collective. Writes a vector, or reads one and creates it with its original layout. A null
  /// vector is read back as null.
  void vector(OwnedVec& values);

  Stream common;  ///< the same on all ranks; rank 0 stores it
  Stream own;     ///< of this rank

 private:
  MPI_Comm comm_;
};

}  // namespace squeal::checkpoint
