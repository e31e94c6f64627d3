#pragma once
/// Elements that a mesh holds twice. Not collective: rank 0 only.
#include <optional>
#include <utility>

#include "mesh/whole.hpp"

namespace squeal::mesh {

struct ElementPlace {
  std::size_t block, element;
};

/// Two elements on the same nodes: nothing else in a model tells that they are one, and what they
/// contribute counts twice. Elements of one type are the same where all nodes are, elements of two
/// types where their corners are. Of several pairs the one of least tags.
std::optional<std::pair<ElementPlace, ElementPlace>> findTwins(
    const std::vector<WholeBlock>& blocks);

/// The element of least tag that has a node twice.
std::optional<ElementPlace> findRepeatedNode(const std::vector<WholeBlock>& blocks);

}  // namespace squeal::mesh
