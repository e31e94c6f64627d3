#pragma once
/// An archive is a part of the state of a run, on its way to or from a checkpoint.
#include <mpi.h>

#include <utility>
#include <vector>

#include "base/petsc/check.hpp"
#include "base/petsc/owned.hpp"
#include "base/system/stream.hpp"

namespace squeal::checkpoint {

/// What is said of a checkpoint whose files do not hold what they should.
inline constexpr const char* damaged =
    "an entry of the checkpoint does not hold what it should; without -resume the run begins anew";

using squeal::Stream;

/// An Archive holds what all ranks share once, and besides what each rank has alone. The same calls
/// in the same order write it and read it.
class Archive {
 public:
  /// Makes an empty archive to write to.
  explicit Archive(MPI_Comm comm) : comm_(comm) {}
  /// Takes what another archive has written. The common part is the same on all ranks.
  Archive(MPI_Comm comm, std::vector<char> common, std::vector<char> own)
      : common(std::move(common), damaged), own(std::move(own), damaged), comm_(comm) {}
  bool reads() const { return own.reads(); }
  MPI_Comm comm() const { return comm_; }
  /// Collective. Writes a vector, or makes one with the layout that it had; null stays null.
  void vector(OwnedVec& values);

  Stream common;  ///< the same on all ranks; that of rank 0 is kept
  Stream own;     ///< of this rank

 private:
  MPI_Comm comm_;
};

}  // namespace squeal::checkpoint
