// SPDX-License-Identifier: BSD-2-Clause
#include "model/elasticity/hourglass.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "algebra/linalg/symmetric.hpp"
#include "base/petsc/arrays.hpp"
#include "base/petsc/check.hpp"
#include "base/session/stages.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/elasticity/boundary.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/elasticity/element.hpp"
#include "model/element/shape.hpp"

namespace squeal::elasticity {
namespace {

constexpr int hex20 = 17, corners = 8, nodes = 20;

bool anyReduced(const std::vector<Material>& materials) {
  return std::ranges::any_of(materials, &Material::reducedIntegration);
}

/// Collective. Returns 1 for the nodes of boundary faces, [local node].
std::vector<char> boundaryNodes(const mesh::Mesh& mesh) {
  OwnedVec flags = nodalVector(mesh);
  for (const auto& face : boundaryFaces(mesh))
    for (const PetscInt node : face.nodes)
      check(VecSetValue(flags, mesh.dimension * mesh.globalNode[node], 1, INSERT_VALUES));
  check(VecAssemblyBegin(flags));
  check(VecAssemblyEnd(flags));
  const auto values = localValues(mesh, flags);
  std::vector<char> result;
  for (PetscInt node = 0; node < mesh.localNodes(); ++node)
    result.push_back(values[mesh.dimension * node] != 0);
  return result;
}

ExposedCell exposedCell(const mesh::Mesh& mesh, const mesh::CellBlock& block, std::size_t e) {
  const auto local = block.nodesOf(e);
  ExposedCell cell{block.tag[e], block.material[e], mesh.nodePart[local[0]], {}, {}};
  for (std::size_t i = 0; i < nodes; ++i) {
    cell.node[i] = mesh.globalNode[local[i]];
    cell.point[i] = mesh.coordinates[local[i]];
  }
  return cell;
}

}  // namespace

void requireHex20(const mesh::Mesh& mesh, const std::vector<Material>& materials) {
  if (!anyReduced(materials)) return;
  std::vector<int> other(materials.size(), 0);  // a type of the cells that is not hex20
  for (const auto& block : mesh.cells)
    if (block.type != hex20)
      for (const int m : block.material) other[m] = std::max(other[m], block.type);
  mpi::reduce<int>(mesh.comm, other, MPI_MAX);
  for (std::size_t m = 0; m < materials.size(); ++m) {
    if (!materials[m].reducedIntegration || other[m] == 0) continue;
    const std::string name = shapeTable(other[m]).name;
    throw Error("option " + material::integrationName(mesh.materialGroups[m].name) +
                " reduced: " + mesh.materialText(m) + " has " + name +
                " cells, and only hex20 cells have reduced integration; " +
                (name == "hex8"
                     ? "use incompatible modes (-elasticity_incompatible_modes hex8) or hex20"
                     : "use full"));
  }
}

std::vector<ExposedCell> exposedCells(const mesh::Mesh& mesh,
                                      const std::vector<Material>& materials) {
  if (!anyReduced(materials)) return {};
  const auto boundary = boundaryNodes(mesh);
  std::vector<ExposedCell> cells;
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e) {
      if (!materials[block.material[e]].reducedIntegration) continue;
      const auto middles = block.nodesOf(e).subspan(corners);  // of its edges
      if (std::ranges::all_of(middles, [&](PetscInt node) { return boundary[node]; }))
        cells.push_back(exposedCell(mesh, block, e));
    }
  auto all = concatenated(mesh.comm, cells);
  std::ranges::sort(all, {}, [](const auto& cell) { return std::tuple(cell.material, cell.tag); });
  return all;
}

void warnOfHourglass(const mesh::Mesh& mesh, std::span<const ExposedCell> cells) {
  constexpr std::size_t most = 10;
  for (std::size_t m = 0; m < mesh.materialGroups.size(); ++m) {
    std::vector<std::string> tags;
    for (const auto& cell : cells)
      if (cell.material == int(m)) tags.push_back(std::to_string(cell.tag));
    const std::size_t count = tags.size();
    if (count == 0) continue;
    tags.resize(std::min(count, most));
    printWarning(
        mesh.comm,
        "warning: " + mesh.materialText(m) + " has " + std::to_string(count) + " hex20 " +
            (count == 1 ? "cell" : "cells") + " with reduced integration and without an edge " +
            "inside the body, so neighbours hold their hourglass modes weakly or not at all; use " +
            "two cells across the body in two directions, or " +
            material::integrationName(mesh.materialGroups[m].name) + " full: " +
            (count == 1 ? "cell " : "cells ") + joined(tags) + (count > most ? ", …" : ""));
  }
}

linalg::DenseMatrix strainlessBasis(const ExposedCell& cell) {
  const Law law{material::isotropic(1, 0, 3, false), {}};
  const auto k = stiffness(*element::underintegratedTable(hex20),
                           {cell.point.begin(), cell.point.end()}, law, false);
  const int size = 3 * nodes;
  linalg::DenseMatrix vectors(size, size);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) vectors(i, j) = k[i * size + j];
  linalg::symmetricEigen(vectors);
  linalg::DenseMatrix basis(size, strainlessMotions);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < strainlessMotions; ++j)
      basis(i, j) = std::sqrt(double(nodes)) * vectors(i, j);
  return basis;
}

}  // namespace squeal::elasticity
