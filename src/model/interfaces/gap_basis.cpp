// SPDX-License-Identifier: BSD-2-Clause
#include "model/interfaces/gap_basis.hpp"

#include <algorithm>
#include <cmath>

#include "base/petsc/arrays.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/interfaces/algebra.hpp"
#include "model/mortar/basis.hpp"

namespace squeal::interfaces {
namespace {

/// An edge with the local nodes at its middle and at its ends.
struct Edge {
  PetscInt middle, ends[2];
  double alpha;
};

/// Returns the edges of the faces whose gaps are combined.
std::vector<Edge> combinedEdges(const mesh::Mesh& mesh, const std::vector<std::string>& surfaces,
                                const std::vector<int>& interfaceOf) {
  std::vector<Edge> found;
  for (const auto& block : mesh.faces) {
    const auto& type = mortar::faceType(block.type);
    const double alpha = mortar::usualAlpha(type, mortar::Cover::full);
    for (std::size_t e = 0; alpha > 0 && e < block.surface.size(); ++e) {
      const auto& surface = mesh.surfaces[block.surface[e]];
      if (std::find(surfaces.begin(), surfaces.end(), surface) == surfaces.end()) continue;
      const auto nodes = block.nodesOf(e);
      for (const auto& edge : type.edges) {
        const Edge local{nodes[edge.node], {nodes[edge.corners[0]], nodes[edge.corners[1]]}, alpha};
        const int interface = interfaceOf[local.middle];
        if (interface >= 0 && interfaceOf[local.ends[0]] == interface &&
            interfaceOf[local.ends[1]] == interface)
          found.push_back(local);
      }
    }
  }
  return found;
}

/// Returns true if all rows are identity rows.
bool allAreIdentity(const mesh::Mesh& mesh, const std::vector<CombinedGap>& given) {
  return std::all_of(given.begin(), given.end(), [&](const auto& gap) {
    return gap.row.size() == 1 && gap.row[0].node == mesh.globalNode[gap.node] &&
           std::abs(gap.row[0].value - 1) < 1e-12;
  });
}

}  // namespace

GapBasis gapBasis(const mesh::Mesh& mesh, const std::vector<std::string>& surfaces,
                  const std::vector<int>& interfaceOf, const std::vector<CombinedGap>& given,
                  Mat periodic) {
  const int gap = mesh.dimension - 1;
  const auto row = [&](PetscInt globalNode) { return mesh.dimension * globalNode + gap; };
  const auto edges = combinedEdges(mesh, surfaces, interfaceOf);
  GapBasis basis;
  const bool needed = !edges.empty() || !allAreIdentity(mesh, given);
  if (!mpi::any(mesh.comm, needed)) return basis;
  const OwnedVec isGiven = elasticity::nodalVector(mesh);  // the rows that are not identity rows
  for (const auto& edge : edges)
    check(VecSetValue(isGiven, row(mesh.globalNode[edge.middle]), 1, INSERT_VALUES));
  for (const auto& node : given)
    check(VecSetValue(isGiven, row(mesh.globalNode[node.node]), 1, INSERT_VALUES));
  check(VecAssemblyBegin(isGiven));
  check(VecAssemblyEnd(isGiven));
  const auto assemble = [&](bool inverse) {
    const OwnedMat matrix = nodalMatrix(mesh, 2);
    for (const auto& edge : edges) {
      const PetscInt middle = row(mesh.globalNode[edge.middle]);
      const double rest = 1 - 2 * edge.alpha;
      check(MatSetValue(matrix, middle, middle, inverse ? 1 / rest : rest, INSERT_VALUES));
      for (PetscInt end : edge.ends)
        check(MatSetValue(matrix, middle, row(mesh.globalNode[end]),
                          inverse ? -edge.alpha / rest : edge.alpha, INSERT_VALUES));
    }
    for (const auto& node : given)
      for (const auto& [column, value] : inverse ? node.inverse : node.row)
        check(MatSetValue(matrix, row(mesh.globalNode[node.node]), row(column), value,
                          INSERT_VALUES));
    {
      const ReadArray isSet(isGiven);
      const PetscInt first = mesh.dimension * mesh.firstNode;
      for (PetscInt i = 0; i < mesh.dimension * mesh.ownedNodes; ++i)
        if (isSet[i] == 0) check(MatSetValue(matrix, first + i, first + i, 1, INSERT_VALUES));
    }
    assembled(matrix);
    OwnedMat folded;
    check(MatMatMult(matrix, periodic, MAT_INITIAL_MATRIX, PETSC_DEFAULT, folded.out()));
    return folded;
  };
  basis.matrix = assemble(false);
  basis.inverse = assemble(true);
  return basis;
}

}  // namespace squeal::interfaces
