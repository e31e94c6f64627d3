// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A small distributed mesh for the writers of fields.
#include "model/mesh/mesh.hpp"
#include "support/harness/ranks.hpp"

namespace squeal::test {

using mesh::Mesh;

/// A bar along x: a brick of unit length on each rank, the last one made of two wedges; the plane
/// of nodes between two ranks is owned by the lower one. With two ranks each has an element type
/// that the other lacks.
inline Mesh bar() {
  const int rank = rankOf(PETSC_COMM_WORLD), size = sizeOf(PETSC_COMM_WORLD);
  Mesh mesh;
  mesh.comm = PETSC_COMM_WORLD;
  mesh.totalNodes = 4 * (size + 1);
  mesh.totalCells = size + 1;
  mesh.ownedNodes = rank == 0 ? 8 : 4;
  mesh.firstNode = rank == 0 ? 0 : 4 * (rank + 1);
  const auto addPlane = [&](int plane) {
    for (int corner = 0; corner < 4; ++corner) {
      const int node = 4 * plane + corner;
      mesh.globalNode.push_back(node);
      mesh.coordinates.push_back(
          {double(plane), corner == 1 || corner == 2 ? 1.0 : 0.0, corner / 2 + 1e-12 * node});
      mesh.nodeTag.push_back(100 + node);
      mesh.nodePart.push_back(plane > 0);
    }
  };
  if (rank == 0) addPlane(0);
  addPlane(rank + 1);
  if (rank > 0) addPlane(rank);
  const PetscInt low = rank == 0 ? 0 : 4,
                 high = 4 - low;  // first local node of the two planes of the cell
  if (rank + 1 < size)
    mesh.cells = {{5,
                   8,
                   {low, low + 1, low + 2, low + 3, high, high + 1, high + 2, high + 3},
                   {0},
                   {1000 + rank}}};
  else
    mesh.cells = {{6,
                   6,
                   {low, low + 1, low + 2, high, high + 1, high + 2, low, low + 2, low + 3, high,
                    high + 2, high + 3},
                   {1, 0},
                   {1000 + rank, 1001 + rank}}};
  mesh.parts = 2;
  mesh.bodies = mesh.partName = {"disc", "pad"};
  return mesh;
}

/// The same, where the wedges are two sections of the pad.
inline Mesh sectionedBar() {
  Mesh mesh = bar();
  mesh.materialGroups = {{"disc", 0, false}, {"first", 1, true}, {"second", 1, true}};
  for (auto& block : mesh.cells) {
    const bool wedges = block.type == 6;
    block.body.assign(block.tag.size(), wedges);
    block.material = wedges ? std::vector<int>{1, 2} : std::vector<int>{0};
  }
  return mesh;
}

}  // namespace squeal::test
