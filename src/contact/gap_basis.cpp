#include "contact/gap_basis.hpp"

#include <algorithm>

#include "contact/algebra.hpp"
#include "elasticity/elasticity.hpp"
#include "elasticity/shape.hpp"
#include "petsc/arrays.hpp"

namespace squeal::contact {
namespace {

/// Calls action(middle, end, end), with local nodes, for each combined edge of the faces.
template <class Action>
void forEachEdge(const mesh::Mesh& mesh, const std::vector<std::string>& surfaces,
                 const Action& action) {
  for (const auto& block : mesh.faces) {
    const auto edges = combinedEdges(block.type);
    for (std::size_t e = 0; !edges.empty() && e < block.surface.size(); ++e) {
      const auto& surface = mesh.surfaces[block.surface[e]];
      if (std::find(surfaces.begin(), surfaces.end(), surface) == surfaces.end()) continue;
      const auto nodes = block.nodesOf(e);
      for (const auto& edge : edges)
        action(nodes[edge.middle], nodes[edge.ends[0]], nodes[edge.ends[1]]);
    }
  }
}

}  // namespace

std::vector<FaceEdge> combinedEdges(int gmshType) {
  const auto& name = elasticity::shapeTable(gmshType).name;
  if (name == "tri6") return {{3, {0, 1}}, {4, {1, 2}}, {5, {2, 0}}};
  if (name == "quad8") return {{4, {0, 1}}, {5, {1, 2}}, {6, {2, 3}}, {7, {3, 0}}};
  return {};
}

GapBasis gapBasis(const mesh::Mesh& mesh, const std::vector<std::string>& surfaces, Mat periodic) {
  const int gap = mesh.dimension - 1;
  const auto row = [&](PetscInt node) { return mesh.dimension * mesh.globalNode[node] + gap; };
  const OwnedVec isMiddle = elasticity::nodalVector(mesh);
  forEachEdge(mesh, surfaces, [&](PetscInt middle, PetscInt, PetscInt) {
    check(VecSetValue(isMiddle, row(middle), 1, INSERT_VALUES));
  });
  check(VecAssemblyBegin(isMiddle));
  check(VecAssemblyEnd(isMiddle));
  PetscReal any = 0;
  check(VecNorm(isMiddle, NORM_INFINITY, &any));
  GapBasis basis;
  if (any == 0) return basis;
  const auto combined = [&](double middleShare, double endShare) {
    const OwnedMat matrix = nodalMatrix(mesh, 2);
    forEachEdge(mesh, surfaces, [&](PetscInt middle, PetscInt a, PetscInt b) {
      check(MatSetValue(matrix, row(middle), row(middle), middleShare, INSERT_VALUES));
      for (PetscInt end : {a, b})
        check(MatSetValue(matrix, row(middle), row(end), endShare, INSERT_VALUES));
    });
    const ReadArray middles(isMiddle);
    const PetscInt first = mesh.dimension * mesh.firstNode;
    for (PetscInt i = 0; i < mesh.dimension * mesh.ownedNodes; ++i)
      if (middles[i] == 0) check(MatSetValue(matrix, first + i, first + i, 1, INSERT_VALUES));
    assembled(matrix);
    OwnedMat folded;
    check(MatMatMult(matrix, periodic, MAT_INITIAL_MATRIX, PETSC_DEFAULT, folded.out()));
    return folded;
  };
  constexpr double rest = 1 - 2 * edgeShare;
  basis.matrix = combined(rest, edgeShare);
  basis.inverse = combined(1 / rest, -edgeShare / rest);
  return basis;
}

}  // namespace squeal::contact
