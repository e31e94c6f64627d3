// SPDX-License-Identifier: BSD-2-Clause
#include "model/mesh/partition.hpp"

#include <metis.h>

#include <algorithm>
#include <memory>
#include <set>

#include "base/petsc/check.hpp"

namespace squeal::mesh {
namespace {

/// Weights that all ranks should have the same share of.
struct Weights {
  idx_t kinds;                 ///< of weights
  std::vector<idx_t> ofCells;  ///< [cell][kind]
};

/// Returns the number of nodes of each cell and, with `withFaces` and if there are any, of its
/// faces on surfaces: the equations of tied surfaces and of surfaces in contact are longer, since
/// they couple both sides.
Weights weights(const WholeMesh& mesh, bool withFaces) {
  std::vector<idx_t> faces(mesh.cellCount(), 0);
  for (const auto& block : mesh.faces)
    for (const PetscInt cell : block.cell) ++faces[cell];
  const bool two = withFaces && std::ranges::any_of(faces, [](idx_t count) { return count > 0; });
  Weights found{two ? 2 : 1, {}};
  std::size_t cell = 0;
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e, ++cell) {
      found.ofCells.push_back(block.nodesPerElement);
      if (two) found.ofCells.push_back(faces[cell]);
    }
  return found;
}

/// The dual graph of the cells, borrowed.
struct Graph {
  idx_t cells;
  idx_t *begin, *neighbour;  // [cell], [edge]
};

/// Returns the rank of each cell.
std::vector<idx_t> partition(Graph graph, Weights weights, idx_t ranks) {
  idx_t cut = 0;
  std::vector<idx_t> rankOfCell(graph.cells);
  if (METIS_PartGraphKway(&graph.cells, &weights.kinds, graph.begin, graph.neighbour,
                          weights.ofCells.data(), nullptr, nullptr, &ranks, nullptr, nullptr,
                          nullptr, &cut, rankOfCell.data()) != METIS_OK)
    throw Error("METIS cannot partition the mesh");
  return rankOfCell;
}

}  // namespace

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
  std::vector<idx_t> start{0}, corners;
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e) {
      for (PetscInt node : block.cornersOf(e)) corners.push_back(canonical[node]);
      start.push_back(corners.size());
    }
  idx_t elements = mesh.cellCount(), nodes = mesh.nodeCount(), base = 0;
  idx_t common =
      mesh.dimension;  // corners shared by neighbours: an edge in the plane, a triangle in space
  idx_t *begin = nullptr, *neighbour = nullptr;
  if (METIS_MeshToDual(&elements, &nodes, start.data(), corners.data(), &common, &base, &begin,
                       &neighbour) != METIS_OK)
    throw Error("METIS cannot partition the mesh");
  const std::unique_ptr<idx_t, int (*)(void*)> owners[] = {{begin, METIS_Free},
                                                           {neighbour, METIS_Free}};
  const Graph graph{elements, begin, neighbour};
  auto rankOfCell = partition(graph, weights(mesh, true), ranks);
  // With few cells, two kinds of weights may leave a rank without any.
  if (std::set<idx_t>(rankOfCell.begin(), rankOfCell.end()).size() < std::size_t(ranks))
    rankOfCell = partition(graph, weights(mesh, false), ranks);
  return {rankOfCell.begin(), rankOfCell.end()};
}

}  // namespace squeal::mesh
