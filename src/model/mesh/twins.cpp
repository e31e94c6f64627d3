// SPDX-License-Identifier: BSD-2-Clause
#include "model/mesh/twins.hpp"

#include <algorithm>
#include <cstdint>
#include <tuple>

namespace squeal::mesh {

std::vector<PetscInt> sorted(std::span<const PetscInt> nodes) {
  std::vector<PetscInt> list(nodes.begin(), nodes.end());
  std::sort(list.begin(), list.end());
  return list;
}

namespace {

/// Returns a hash, which is equal for equal nodes and rarely equal for others.
std::uint64_t hashed(const std::vector<PetscInt>& nodes) {
  std::uint64_t hash = 0;
  for (std::uint64_t node : nodes) {  // the steps of splitmix64
    hash += node + 0x9e3779b97f4a7c15;
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111eb;
    hash ^= hash >> 31;
  }
  return hash;
}

bool same(const WholeBlock& a, std::size_t i, const WholeBlock& b, std::size_t j) {
  if (a.type == b.type) return sorted(a.nodesOf(i)) == sorted(b.nodesOf(j));
  return sorted(a.cornersOf(i)) == sorted(b.cornersOf(j));
}

}  // namespace

std::optional<std::pair<ElementPlace, ElementPlace>> findTwins(
    const std::vector<WholeBlock>& blocks) {
  struct Key {
    std::uint64_t hash;
    ElementPlace place;
  };
  std::vector<Key> keys;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (std::size_t e = 0; e < blocks[b].tag.size(); ++e)
      keys.push_back({hashed(sorted(blocks[b].cornersOf(e))), {b, e}});
  const auto tag = [&](const ElementPlace& place) {
    return blocks[place.block].tag[place.element];
  };
  std::sort(keys.begin(), keys.end(), [&](const Key& a, const Key& b) {
    return std::tuple(a.hash, tag(a.place), a.place.block, a.place.element) <
           std::tuple(b.hash, tag(b.place), b.place.block, b.place.element);
  });
  std::optional<std::pair<ElementPlace, ElementPlace>> twins;
  for (std::size_t first = 0; first < keys.size(); ++first)
    for (std::size_t next = first + 1; next < keys.size() && keys[next].hash == keys[first].hash;
         ++next) {
      const auto &a = keys[first].place, &b = keys[next].place;
      if (twins && tag(a) >= tag(twins->first)) continue;
      if (same(blocks[a.block], a.element, blocks[b.block], b.element)) twins = {a, b};
    }
  return twins;
}

std::optional<ElementPlace> findRepeatedNode(const std::vector<WholeBlock>& blocks) {
  std::optional<ElementPlace> found;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (std::size_t e = 0; e < blocks[b].tag.size(); ++e) {
      if (found && blocks[b].tag[e] >= blocks[found->block].tag[found->element]) continue;
      const auto nodes = sorted(blocks[b].nodesOf(e));
      if (std::adjacent_find(nodes.begin(), nodes.end()) != nodes.end()) found = {b, e};
    }
  return found;
}

}  // namespace squeal::mesh
