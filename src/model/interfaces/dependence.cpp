// SPDX-License-Identifier: BSD-2-Clause
#include "model/interfaces/dependence.hpp"

#include "base/petsc/check.hpp"
#include "model/interfaces/algebra.hpp"

namespace squeal::interfaces {
namespace {

/// Not collective. Sets the entries of a block of two global nodes that are not zero.
void setEntries(Mat matrix, int dimension, PetscInt rowNode, PetscInt columnNode,
                const mesh::Matrix3& block) {
  for (int i = 0; i < dimension; ++i)
    for (int j = 0; j < dimension; ++j)
      if (block[i][j] != 0)
        check(MatSetValue(matrix, dimension * rowNode + i, dimension * columnNode + j, block[i][j],
                          INSERT_VALUES));
}

void setTied(const mesh::Mesh& mesh, const TiedNode& tied, Mat rows) {
  const int dimension = mesh.dimension;
  const PetscInt global = mesh.firstNode + tied.connection.node;
  for (const auto& [master, weight] : tied.connection.masters) {
    auto block = identity(dimension, weight);
    for (int d = 0; d < dimension; ++d)
      if (tied.apart[d]) block[d * dimension + d] = 0;
    setBlock(rows, dimension, global, master, block);
  }
  for (int d = 0; d < dimension; ++d)
    if (const PetscInt row = dimension * global + d; tied.apart[d])
      check(MatSetValue(rows, row, row, 1, INSERT_VALUES));
}

}  // namespace

std::vector<int> levelsOfFollowers(const mesh::Mesh& mesh, const Interfaces& all) {
  std::vector<int> levels(mesh.ownedNodes, 0);
  for (const auto& tied : all.tied) levels[tied.connection.node] = tied.connection.level;
  for (const auto& coupled : all.coupled) levels[coupled.node] = coupled.level;
  return levels;
}

void countBlocks(const Interfaces& all, int level, std::vector<PetscInt>& blocks) {
  for (const auto& tied : all.tied)
    if (tied.connection.level == level)
      blocks[tied.connection.node] += tied.connection.masters.size();
  for (const auto& coupled : all.coupled)
    if (coupled.level == level) blocks[coupled.node] += coupled.masters.size();
}

void setFollowers(const mesh::Mesh& mesh, const Interfaces& all, int level, Mat rows) {
  for (const auto& tied : all.tied)
    if (tied.connection.level == level) setTied(mesh, tied, rows);
  for (const auto& coupled : all.coupled) {
    if (coupled.level != level) continue;
    const PetscInt global = mesh.firstNode + coupled.node;
    setEntries(rows, mesh.dimension, global, global, coupled.own);
    for (const auto& master : coupled.masters)
      setEntries(rows, mesh.dimension, global, master.node, master.block);
  }
}

OwnedMat turnedAxes(const mesh::Mesh& mesh, const Interfaces& all) {
  OwnedMat rows = nodalMatrix(mesh, 1);
  auto levels = levelsOfFollowers(mesh, all);
  for (const auto& connection : all.connections) levels[connection.node] = connection.level;
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node) {
    const PetscInt global = mesh.firstNode + node;
    const auto turned = all.constraints.axes.find(node);
    if (turned == all.constraints.axes.end() || levels[node] > 0) {
      setDiagonal(rows, mesh.dimension, global);
      continue;
    }
    mesh::Matrix3 columns{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) columns[i][k] = turned->second[k][i];
    setEntries(rows, mesh.dimension, global, global, columns);
  }
  assembled(rows);
  return rows;
}

OwnedMat rowsOfLevel(const mesh::Mesh& mesh, const Interfaces& all, int level) {
  const auto levels = levelsOfFollowers(mesh, all);
  std::vector<PetscInt> blocks(mesh.ownedNodes, 1);
  countBlocks(all, level, blocks);
  OwnedMat factor = nodalMatrix(mesh, blocks);
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    if (levels[node] != level) setDiagonal(factor, mesh.dimension, mesh.firstNode + node);
  setFollowers(mesh, all, level, factor);
  assembled(factor);
  return factor;
}

OwnedMat followedRows(const mesh::Mesh& mesh, const Interfaces& all) {
  OwnedMat rows;
  if (all.constraints.anyTurned) rows = turnedAxes(mesh, all);
  for (int level = 1; level <= all.levels; ++level) {
    OwnedMat factor = rowsOfLevel(mesh, all, level);
    rows = rows ? product(factor, rows) : std::move(factor);
  }
  return rows;
}

void rejectTwoMasters(const mesh::Mesh& mesh, const Interfaces& all) {
  std::vector<std::string> masters(mesh.ownedNodes);
  for (const auto& tied : all.tied)
    masters[tied.connection.node] = "is the slave of " + all.options[tied.interface].label();
  for (const auto& node : all.nodes)
    masters[node.node] = "is the slave of " + all.options[node.interface].label();
  for (const auto& image : mesh.images) masters[image.node] = "is a periodic image";
  std::string failure;
  for (const auto& coupled : all.coupled)
    if (const std::string& other = masters[coupled.node]; !other.empty())
      failure = "over-constrained: the node at " + text(mesh.coordinates[coupled.node]) +
                " follows " + all.couplings[coupled.coupling] + " and " + other +
                "; take it out of the group, or exchange slave and master";
  failTogether(mesh.comm, failure);
}

}  // namespace squeal::interfaces
