#pragma once
/// The state of each contact node, and whether the ranks agree on it.
#include <mpi.h>

#include <vector>

namespace squeal::contact {

/// One flag per contact node of this rank.
using Mask = std::vector<unsigned char>;

/// The contact nodes that are closed, and the sticking ones that have been released to slide.
struct ActiveSet {
  Mask closed;
  Mask released;

  bool operator==(const ActiveSet&) const = default;
};

/// Collective. Returns true if the two sets agree on every rank.
bool sameOnAllRanks(MPI_Comm comm, const ActiveSet& a, const ActiveSet& b);

}  // namespace squeal::contact
