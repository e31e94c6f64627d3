// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// For each slave face, the master faces that may touch it, on whichever rank they
/// are.
#include <span>

#include "model/coupling/box.hpp"

namespace squeal::coupling {

/// The master faces near the slave faces of this rank.
struct Candidates {
  /// Each face that is a candidate here, once. They stand in the order of their coordinates, which
  /// no number of ranks changes.
  std::vector<Face> masters;
  std::vector<std::vector<std::size_t>> ofSlave;  ///< [slave] indices into masters, ascending
  std::size_t received = 0;  ///< number of faces that other ranks sent, candidates or not
};

/// Collective. Finds for each slave face of this rank the faces among the masters of all ranks that
/// may be within `distances`[slave] of it, m: those whose box touches that of the slave, widened by
/// the distance on all sides. None that is so near is left out. A distance should exceed the
/// rounding of the coordinates. Each rank gives the faces that it has, perhaps none. All ranks hold
/// at most 8 boxes of each (48 bytes a box); faces go only to ranks with a box that they touch.
/// Throws Error on all ranks if the faces for one rank exceed 2 GiB.
Candidates candidates(MPI_Comm comm, const std::vector<Face>& slaves,
                      const std::vector<Face>& masters, std::span<const double> distances);

}  // namespace squeal::coupling
