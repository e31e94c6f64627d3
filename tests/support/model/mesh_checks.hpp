// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// These checks hold for every distributed mesh. All functions are collective.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "model/elasticity/face.hpp"
#include "model/element/shape.hpp"
#include "model/mesh/mesh.hpp"
#include "support/harness/ranks.hpp"
#include "support/run/case.hpp"

namespace squeal::test {

/// Coordinates of the owned nodes of all ranks in the order of their global numbers.
inline std::vector<double> allCoordinates(const mesh::Mesh& mesh) {
  std::vector<double> mine;
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    mine.insert(mine.end(), mesh.coordinates[node].begin(), mesh.coordinates[node].end());
  return gathered(mine, MPI_DOUBLE);
}

/// Number of nodes of a group on all ranks.
inline PetscInt groupSize(const mesh::Mesh& mesh, const std::string& group) {
  return static_cast<PetscInt>(total(static_cast<double>(mesh.nodeGroups.at(group).size())));
}

/// Each rank owns a range of the global numbers, and its ghosts are nodes of the others.
inline void expectNumbering(const mesh::Mesh& mesh) {
  const auto size = mesh.globalNode.size();
  ASSERT_EQ(mesh.coordinates.size(), size);
  ASSERT_EQ(mesh.nodeTag.size(), size);
  ASSERT_EQ(mesh.nodePart.size(), size);
  EXPECT_GT(mesh.ownedNodes, 0);
  EXPECT_EQ(total(static_cast<double>(mesh.ownedNodes)), mesh.totalNodes);
  PetscInt end = 0;
  check(MPI_Scan(&mesh.ownedNodes, &end, 1, MPIU_INT, MPI_SUM, mesh.comm));
  EXPECT_EQ(mesh.firstNode, end - mesh.ownedNodes);
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    EXPECT_EQ(mesh.globalNode[node], mesh.firstNode + node);
  std::set<PetscInt> ghosts(mesh.globalNode.begin() + mesh.ownedNodes, mesh.globalNode.end());
  EXPECT_EQ(ghosts.size(), size - static_cast<std::size_t>(mesh.ownedNodes));
  for (PetscInt ghost : ghosts)
    EXPECT_TRUE(ghost >= 0 && ghost < mesh.totalNodes && (ghost < mesh.firstNode || ghost >= end))
        << ghost;
}

/// A ghost is where its owner says; every local node belongs to a local cell or is owned; cells are
/// whole and on one rank.
inline void expectCells(const mesh::Mesh& mesh) {
  const auto coordinates = allCoordinates(mesh);
  for (PetscInt node = 0; node < mesh.localNodes(); ++node)
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_EQ(mesh.coordinates[node][d],
                coordinates[3 * static_cast<std::size_t>(mesh.globalNode[node]) + d]);
  std::vector<PetscInt> tags;
  std::set<PetscInt> used;
  for (const auto& block : mesh.cells) {
    ASSERT_EQ(block.nodes.size(), block.tag.size() * static_cast<std::size_t>(block.nodesPerCell));
    ASSERT_EQ(block.body.size(), block.tag.size());
    tags.insert(tags.end(), block.tag.begin(), block.tag.end());
    used.insert(block.nodes.begin(), block.nodes.end());
  }
  EXPECT_FALSE(tags.empty());
  for (PetscInt node : used) EXPECT_TRUE(node >= 0 && node < mesh.localNodes());
  for (PetscInt node = mesh.ownedNodes; node < mesh.localNodes(); ++node)
    EXPECT_TRUE(used.count(node));
  const auto all = gathered(tags, MPIU_INT);
  EXPECT_EQ(static_cast<PetscInt>(all.size()), mesh.totalCells);
  EXPECT_EQ(std::set<PetscInt>(all.begin(), all.end()).size(), all.size());
}

/// ∫ n dA over each surface, outwards: [surface][component].
inline std::map<std::string, mesh::Point> areaVectors(const mesh::Mesh& mesh) {
  std::map<std::string, mesh::Point> areas;
  for (std::size_t s = 0; s < mesh.surfaces.size(); ++s) {
    mesh::Point sum{};
    for (const auto& block : mesh.faces)
      for (std::size_t e = 0; e < block.surface.size(); ++e) {
        if (block.surface[e] != static_cast<int>(s)) continue;
        std::vector<mesh::Point> points;
        for (int i = 0; i < block.nodesPerFace; ++i)
          points.push_back(
              mesh.coordinates[block.nodes[e * static_cast<std::size_t>(block.nodesPerFace) +
                                           static_cast<std::size_t>(i)]]);
        const auto normals =
            elasticity::faceNormals(element::shapeTable(block.type), points, block.sign[e]);
        for (std::size_t i = 0; i < normals.size(); ++i) sum[i % 3] += normals[i];
      }
    for (auto& component : sum) component = total(component);
    areas[mesh.surfaces[s]] = sum;
  }
  return areas;
}

}  // namespace squeal::test
