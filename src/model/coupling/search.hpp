// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Search for the master faces, on any rank, that may touch a slave face.
#include <span>

#include "model/coupling/box.hpp"

namespace squeal::coupling {

/// The master faces near the slave faces of this rank.
struct Candidates {
  /// Each candidate face of this rank, once, in an order by coordinates, which does not depend on
  /// the number of ranks.
  std::vector<Face> masters;
  std::vector<std::vector<std::size_t>> ofSlave;  ///< [slave] indices into masters, ascending
  std::size_t received = 0;  ///< number of faces that other ranks sent, candidates or not
};

/// Collective. Finds for each slave face of this rank the master faces of all ranks that may be
/// within `distances`[slave], m: all faces whose box touches that of the slave, widened by the
/// distance on all sides. A distance should exceed the round-off of the coordinates. Each rank
/// passes its own faces, possibly none. Every rank stores at most 8 boxes per rank (48 bytes a
/// box); faces go only to ranks with a box that they touch. Throws Error on all ranks if the faces
/// for one rank exceed 2 GiB.
Candidates candidates(MPI_Comm comm, const std::vector<Face>& slaves,
                      const std::vector<Face>& masters, std::span<const double> distances);

}  // namespace squeal::coupling
