// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The states of the contact nodes, and their comparison over all ranks.
#include <petscsys.h>

#include <cstddef>
#include <vector>

namespace squeal::contact {

/// One flag per contact node of this rank.
using Mask = std::vector<unsigned char>;

/// The closed contact nodes, and the sticking nodes that are released and may slide.
struct ActiveSet {
  Mask closed;
  Mask released;

  /// Returns the set with all nodes closed and none released.
  static ActiveSet bonded(std::size_t nodes) { return {Mask(nodes, 1), Mask(nodes, 0)}; }
  /// Returns the set with all gaps open and none released.
  static ActiveSet open(std::size_t nodes) { return {Mask(nodes, 0), Mask(nodes, 0)}; }

  bool operator==(const ActiveSet&) const = default;
};

/// Collective. Returns true if the two sets agree on every rank.
bool sameOnAllRanks(MPI_Comm comm, const ActiveSet& a, const ActiveSet& b);
/// Collective. Returns the number of contact nodes whose flags differ.
PetscInt countDifferent(MPI_Comm comm, const Mask& a, const Mask& b);
/// Collective. Returns the number of contact nodes that differ in either flag.
PetscInt countDifferent(MPI_Comm comm, const ActiveSet& a, const ActiveSet& b);

/// The nodes that are closed, or released, in any of several sets and in all of them.
struct ActiveSetHull {
  ActiveSet anywhere;    ///< closed if closed in any set; released if released in all
  ActiveSet everywhere;  ///< closed if closed in all sets; released if released in any

  explicit ActiveSetHull(const ActiveSet& first) : anywhere(first), everywhere(first) {}
  void add(const ActiveSet& set);
};

}  // namespace squeal::contact
