// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The eigenpairs of the points of a sweep, for tracking.
#include <mpi.h>

#include <optional>
#include <vector>

#include "algebra/linalg/quadratic.hpp"
#include "base/checkpoint/archive.hpp"
#include "eigen/reduction/point_state.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::reduction {

/// Stores the watched eigenpairs of solved points, up to a memory limit. The pairs of a point are
/// stored on one rank.
class SolvedPairs {
 public:
  explicit SolvedPairs(MPI_Comm comm) : comm_(comm) {}
  /// Not collective. Stores the pairs of these points, whose vectors refer to a basis of this size.
  void store(const std::vector<PointState>& states, PetscInt basisSize);
  /// Collective. Returns the pairs of a point with right and left vectors; none if they are not
  /// stored.
  std::optional<std::vector<linalg::DensePair>> at(const sweep::Parameters& at, int set) const;
  /// Not collective. Writes the pairs that are new since the last call, or reads and adds them.
  void serialise(checkpoint::Archive& archive);

 private:
  struct Entry {
    sweep::Parameters at;
    int set;  // index of the point's set
    int owner;
    std::vector<linalg::DensePair> pairs;  // on the owner
  };
  MPI_Comm comm_;
  std::vector<Entry> entries_;
  double bytes_ = 0;            // total over all ranks
  std::size_t serialised_ = 0;  // entries that the checkpoint contains
};

}  // namespace squeal::reduction
