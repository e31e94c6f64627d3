// SPDX-License-Identifier: BSD-2-Clause
#include "model/mesh/partition.hpp"

#include <metis.h>

#include "base/petsc/check.hpp"

namespace squeal::mesh {

std::vector<int> partition(const WholeMesh& mesh, int ranks) {
  if (ranks == 1) return std::vector<int>(mesh.cellCount(), 0);
  if (mesh.cellCount() < ranks)
    throw Error("the mesh has " + std::to_string(mesh.cellCount()) + " cells, fewer than the " +
                std::to_string(ranks) + " ranks");
  // Partners across contact and periodicity count as one node: their equations are coupled, so that
  // they belong on one rank.
  std::vector<PetscInt> canonical = mesh.primary;
  for (const auto& pair : mesh.pairs)
    if (pair.master >= 0) canonical[pair.node] = pair.master;
  for (auto& node : canonical) node = canonical[node];
  std::vector<idx_t> start{0}, corners, weight;
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e) {
      for (PetscInt node : block.cornersOf(e)) corners.push_back(canonical[node]);
      start.push_back(corners.size());
      weight.push_back(block.nodesPerElement);
    }
  idx_t elements = mesh.cellCount(), nodes = mesh.nodeCount(), parts = ranks, cut = 0;
  idx_t common =
      mesh.dimension;  // corners shared by neighbours: an edge in the plane, a triangle in space
  std::vector<idx_t> elementPart(elements), nodePart(nodes);
  if (METIS_PartMeshDual(&elements, &nodes, start.data(), corners.data(), weight.data(), nullptr,
                         &common, &parts, nullptr, nullptr, &cut, elementPart.data(),
                         nodePart.data()) != METIS_OK)
    throw Error("METIS cannot partition the mesh");
  return {elementPart.begin(), elementPart.end()};
}

}  // namespace squeal::mesh
