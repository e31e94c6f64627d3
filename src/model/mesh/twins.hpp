// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Duplicate elements of a mesh. Not collective: for rank 0 only.
#include <optional>
#include <utility>

#include "model/mesh/whole.hpp"

namespace squeal::mesh {

/// The place of an element in a list of blocks.
struct ElementPlace {
  std::size_t block, element;
};

/// Returns two elements on the same nodes, whose contributions would be added twice; none if there
/// are none. Two elements of the same type are duplicates if all their nodes are the same; two of
/// different types, if their corners are the same. If there are several pairs, returns the one with
/// the smallest tags.
std::optional<std::pair<ElementPlace, ElementPlace>> findTwins(
    const std::vector<WholeBlock>& blocks);

/// Returns an element that has a node twice, the one with the smallest tag if there are several;
/// none if there is none.
std::optional<ElementPlace> findRepeatedNode(const std::vector<WholeBlock>& blocks);

/// Returns the nodes in ascending order.
std::vector<PetscInt> sorted(std::span<const PetscInt> nodes);

}  // namespace squeal::mesh
