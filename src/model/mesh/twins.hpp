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

/// Returns two elements on the same nodes, whose contributions would count twice; none if there are
/// none. Elements of one type are the same if all nodes are; elements of two types, if their
/// corners are. Of several pairs, the one with the smallest tags is returned.
std::optional<std::pair<ElementPlace, ElementPlace>> findTwins(
    const std::vector<WholeBlock>& blocks);

/// Returns the element of the smallest tag that has a node twice; none if there is none.
std::optional<ElementPlace> findRepeatedNode(const std::vector<WholeBlock>& blocks);

/// Returns the nodes in ascending order.
std::vector<PetscInt> sorted(std::span<const PetscInt> nodes);

}  // namespace squeal::mesh
