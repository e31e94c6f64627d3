// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Search for the master faces, on any rank, that may touch a slave face.
#include <span>

#include "model/coupling/box.hpp"

namespace squeal::coupling {

/// The master faces near the slave faces of this rank.
struct Candidates {
  /// All candidate faces of this rank, each once. They are ordered by coordinates, so the order
  /// does not depend on the number of ranks.
  std::vector<Face> masters;
  std::vector<std::vector<std::size_t>> ofSlave;  ///< [slave] indices into masters, ascending
  std::size_t received = 0;  ///< number of faces that other ranks sent, candidates or not
};

/// Collective. Finds for each slave face of this rank the master faces of all ranks that may be
/// within `distances`[slave], m. These are all faces whose box touches that of the slave face,
/// widened by the distance on all sides. A distance should exceed the round-off of the coordinates.
/// Each rank passes its own faces, possibly none. Every rank stores at most 8 boxes of each rank
/// (48 bytes per box). Faces are sent only to ranks with a box that they touch. Throws Error on all
/// ranks if the faces for one rank exceed 2 GiB.
Candidates candidates(MPI_Comm comm, const std::vector<Face>& slaves,
                      const std::vector<Face>& masters, std::span<const double> distances);

}  // namespace squeal::coupling
