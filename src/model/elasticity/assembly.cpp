// SPDX-License-Identifier: BSD-2-Clause
#include "model/elasticity/assembly.hpp"

#include <algorithm>

#include "base/petsc/arrays.hpp"
#include "base/session/stages.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"

namespace squeal::elasticity {

namespace {

/// Collective. Returns an N×N matrix without entries.
OwnedMat nodalMatrix(const mesh::Mesh& mesh, PetscInt dimension) {
  OwnedMat matrix;
  const PetscInt owned = dimension * mesh.ownedNodes;
  check(MatCreate(mesh.comm, matrix.out()));
  check(MatSetSizes(matrix, owned, owned, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetBlockSize(matrix, dimension));
  check(MatSetType(matrix, MATAIJ));
  return matrix;
}

/// Collective. Gives an assembled matrix the required symmetry.
void makeSymmetric(Mat matrix, SymmetryClass symmetry) {
  if (symmetry != SymmetryClass::rounded) {  // (A ± Aᵀ)/2
    OwnedMat transposed;
    check(MatTranspose(matrix, MAT_INITIAL_MATRIX, transposed.out()));
    check(MatAXPY(matrix, symmetry == SymmetryClass::skew ? -1 : 1, transposed,
                  SAME_NONZERO_PATTERN));
    check(MatScale(matrix, 0.5));
  }
  check(MatSetOption(matrix, MAT_SYMMETRIC,
                     symmetry == SymmetryClass::skew ? PETSC_FALSE : PETSC_TRUE));
}

}  // namespace

OwnedMat toMatrix(const mesh::Mesh& mesh, Triples& triples, SymmetryClass symmetry) {
  OwnedMat matrix = nodalMatrix(mesh, mesh.dimension);
  check(MatSetPreallocationCOO(matrix, triples.row.size(), triples.row.data(),
                               triples.column.data()));
  check(MatSetValuesCOO(matrix, triples.value.data(), INSERT_VALUES));
  triples = {};
  makeSymmetric(matrix, symmetry);
  return matrix;
}

void append(Triples& triples, const mesh::Mesh& mesh, std::span<const PetscInt> nodes,
            const std::vector<double>& matrix) {
  const int dimension = mesh.dimension, size = dimension * nodes.size();
  const auto number = [&](int i) {
    return dimension * mesh.globalNode[nodes[i / dimension]] + i % dimension;
  };
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) triples.add(number(i), number(j), matrix[i * size + j]);
}

NodePattern::NodePattern(const mesh::Mesh& mesh, const CellFilter& uses)
    : own(mesh.ownedNodes), other(mesh.ownedNodes) {
  std::vector<std::vector<PetscInt>> neighbours(mesh.localNodes());
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e) {
      if (!uses(block, e)) continue;
      const auto nodes = block.nodesOf(e);
      for (const PetscInt node : nodes)
        neighbours[node].insert(neighbours[node].end(), nodes.begin(), nodes.end());
    }
  std::vector<PetscInt> rows, columns;
  for (PetscInt node = 0; node < std::ssize(neighbours); ++node) {
    auto& list = neighbours[node];
    std::ranges::sort(list);
    list.erase(std::ranges::unique(list).begin(), list.end());
    for (const PetscInt neighbour : list) {
      rows.push_back(mesh.globalNode[node]);
      columns.push_back(mesh.globalNode[neighbour]);
    }
    list = std::vector<PetscInt>();  // {} would retain the memory
  }
  for (PetscInt i = 0; i < mesh.ownedNodes; ++i) {  // springs are on the diagonal
    rows.push_back(mesh.firstNode + i);
    columns.push_back(mesh.firstNode + i);
  }
  const OwnedMat pairs = nodalMatrix(mesh, 1);
  const std::vector<PetscScalar> values(rows.size());
  check(MatSetPreallocationCOO(pairs, rows.size(), rows.data(), columns.data()));
  check(MatSetValuesCOO(pairs, values.data(), INSERT_VALUES));
  for (PetscInt i = 0; i < mesh.ownedNodes; ++i) {
    PetscInt count = 0;
    const PetscInt* list = nullptr;
    check(MatGetRow(pairs, mesh.firstNode + i, &count, &list, nullptr));
    own[i] = std::count_if(list, list + count, [&](PetscInt node) {
      return node >= mesh.firstNode && node < mesh.firstNode + mesh.ownedNodes;
    });
    other[i] = count - own[i];
    check(MatRestoreRow(pairs, mesh.firstNode + i, &count, &list, nullptr));
  }
}

Assembly::Assembly(const mesh::Mesh& mesh, const NodePattern& pattern, bool diagonal)
    : mesh_(&mesh), matrix_(nodalMatrix(mesh, mesh.dimension)) {
  const auto perRow = [&](const std::vector<PetscInt>& perNode) {
    std::vector<PetscInt> counts;
    for (const PetscInt count : perNode)
      counts.insert(counts.end(), mesh.dimension, diagonal ? count : mesh.dimension * count);
    return counts;
  };
  const auto own = perRow(pattern.own), other = perRow(pattern.other);
  check(MatSeqAIJSetPreallocation(matrix_, 0, own.data()));
  check(MatMPIAIJSetPreallocation(matrix_, 0, own.data(), 0, other.data()));
}

void Assembly::add(std::span<const PetscInt> nodes, const std::vector<double>& matrix,
                   bool scalar) {
  const PetscInt count = nodes.size(), dimension = mesh_->dimension;
  numbers_.resize(count);
  for (PetscInt i = 0; i < count; ++i) numbers_[i] = mesh_->globalNode[nodes[i]];
  if (!scalar) {
    check(MatSetValuesBlocked(matrix_, count, numbers_.data(), count, numbers_.data(),
                              matrix.data(), ADD_VALUES));
    return;
  }
  for (PetscInt i = 0; i < count; ++i) numbers_[i] *= dimension;
  for (PetscInt d = 0; d < dimension; ++d) {
    check(MatSetValues(matrix_, count, numbers_.data(), count, numbers_.data(), matrix.data(),
                       ADD_VALUES));
    for (PetscInt& number : numbers_) ++number;
  }
}

void Assembly::addRows(Mat matrix) {
  if (!matrix) return;
  const PetscInt first = mesh_->dimension * mesh_->firstNode,
                 rows = mesh_->dimension * mesh_->ownedNodes;
  for (PetscInt i = first; i < first + rows; ++i) {
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    check(MatGetRow(matrix, i, &count, &columns, &values));
    check(MatSetValues(matrix_, 1, &i, count, columns, values, ADD_VALUES));
    check(MatRestoreRow(matrix, i, &count, &columns, &values));
  }
}

OwnedMat Assembly::finish(SymmetryClass symmetry) {
  check(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
  makeSymmetric(matrix_, symmetry);
  return std::move(matrix_);
}

void addLoad(Vec load, const mesh::Mesh& mesh, std::span<const PetscInt> nodes,
             const std::vector<double>& values, double factor) {
  for (int i = 0; i < std::ssize(nodes); ++i)
    for (int d = 0; d < mesh.dimension; ++d)
      check(VecSetValue(load, mesh.dimension * mesh.globalNode[nodes[i]] + d,
                        factor * values[3 * i + d], ADD_VALUES));
}

std::vector<Point> pointsOf(const mesh::Mesh& mesh, std::span<const PetscInt> nodes) {
  std::vector<Point> points;
  for (PetscInt node : nodes) points.push_back(mesh.coordinates[node]);
  return points;
}

namespace {

/// The number of some cells of all ranks, and a list of the first ten by tag.
struct CellsNamed {
  PetscInt count = 0;
  std::string words;
};

/// Collective. Returns the number of the cells of all ranks and the first names.
CellsNamed named(const mesh::Mesh& mesh, std::vector<CellName> cells) {
  constexpr PetscInt most = 10;
  CellsNamed result;
  result.count = cells.size();
  result.count = mpi::sum(mesh.comm, result.count);
  if (result.count == 0) return result;
  std::sort(cells.begin(), cells.end());
  if (std::ssize(cells) > most) cells.erase(cells.begin() + most, cells.end());
  auto all = concatenated(mesh.comm, cells);
  std::sort(all.begin(), all.end());
  std::vector<std::string> words;
  for (PetscInt i = 0; i < std::min(most, result.count); ++i) {
    const auto [tag, type, body] = all[i];
    words.push_back("cell " + std::to_string(tag) + " (" + shapeTable(type).name + ") of group '" +
                    mesh.bodies[body] + "'");
  }
  result.words = joined(words) + (result.count > most ? ", …" : "");
  return result;
}

}  // namespace

InvertedCell invertedCell(const mesh::CellBlock& block, std::size_t e,
                          const std::vector<Point>& nodes) {
  const ShapeTable& table = shapeTable(block.type);
  return {nameOf(block, e), jacobianRatio(block.type, nodes),
          table.nodes == table.corners ||
              folded(stiffnessTable(block.type), straightened(block.type, nodes))};
}

void failOnInverted(const mesh::Mesh& mesh, const std::vector<InvertedCell>& inverted) {
  std::vector<CellName> names;
  double worst = 1;
  PetscInt byCorners = 0;
  for (const auto& cell : inverted) {
    names.push_back(cell.name);
    worst = std::min(worst, cell.ratio);
    byCorners += cell.byCorners;
  }
  const auto [count, words] = named(mesh, names);
  if (count == 0) return;
  worst = mpi::min(mesh.comm, worst);
  byCorners = mpi::sum(mesh.comm, byCorners);
  const std::string least = formatted("; the worst ratio to its largest value is %.2g", worst);
  std::string message =
      count == 1 ? "inverted element: " + words + " has a Jacobian that is not positive" + least
                 : "inverted elements: " + std::to_string(count) +
                       " cells have a Jacobian that is not positive" + least + ": " + words;
  if (byCorners < count) message += "; -mesh_straighten bad straightens the edges of such cells";
  if (byCorners > 0)
    message += "; with straight edges, from only the corners, it is still not positive in " +
               std::to_string(byCorners) + " of these cells: mesh again";
  throw Error(message);
}

void warnOfFoldedCells(const mesh::Mesh& mesh) {
  std::vector<CellName> cells;
  forEachCell(mesh, [&](const mesh::CellBlock& block, std::size_t e, const ShapeTable& table,
                        const std::vector<Point>& points) {
    if (folded(table, points)) cells.push_back(nameOf(block, e));
  });
  const auto [count, words] = named(mesh, cells);
  if (count > 0)
    printWarning(mesh.comm,
                 "warning: " + std::to_string(count) +
                     (count == 1 ? " curved cell has" : " curved cells have") +
                     " a Jacobian that is not positive near an edge; stiffness is "
                     "integrated at fewer points there (-mesh_straighten bad straightens "
                     "such cells): " +
                     words);
}

}  // namespace squeal::elasticity
