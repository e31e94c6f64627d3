#include "coupling/matrices.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "petsc/arrays.hpp"

namespace squeal::coupling {
namespace {

/// Collective. Scales the rows, or the columns, of a matrix by values at nodes, [local node].
void scale(const mesh::Mesh& mesh, Mat matrix, const std::vector<double>& values, bool columns) {
  OwnedVec factors;
  check(VecCreateMPI(mesh.comm, mesh.ownedNodes, PETSC_DETERMINE, factors.out()));
  std::copy(values.begin(), values.begin() + mesh.ownedNodes, WriteArray(factors).begin());
  check(MatDiagonalScale(matrix, columns ? nullptr : factors.get(),
                         columns ? factors.get() : nullptr));
}

std::vector<double> inverted(std::vector<double> values) {
  for (double& value : values) value = value == 0 ? 0 : 1 / value;
  return values;
}

/// Collective. Returns the matrix with the rows
///   1 on the diagonal of a pivot at a corner,   (middle, end, end) of a pivot within an edge.
OwnedMat edgeMatrix(const mesh::Mesh& mesh, const NodeExchange& exchange,
                    const std::vector<CoveredFace>& faces, const Basis& basis,
                    const Pivoting& pivoting,
                    const std::function<std::array<double, 2>(double alpha)>& middleAndEnd) {
  std::vector<double> facesAt(mesh.localNodes(), 0.0);  // [mid-edge node]: both add to one row
  const auto forEachEdge = [&](const auto& action) {
    for (const auto& face : faces)
      for (const auto& edge : face.type->edges) {
        const PetscInt middle = face.local[edge.node];
        if (basis.alpha[middle] > 0 && pivoting.ratio[middle] != 0) action(face, edge, middle);
      }
  };
  forEachEdge([&](const auto&, const auto&, PetscInt middle) { ++facesAt[middle]; });
  exchange.sum(facesAt);
  Triples triples;
  forEachEdge([&](const CoveredFace& face, const mortar::MidEdge& edge, PetscInt middle) {
    const auto [atMiddle, atEnd] = middleAndEnd(basis.alpha[middle]);
    const PetscInt row = face.face->nodes[edge.node];
    triples.add(row, row, atMiddle / facesAt[middle]);
    for (int corner : edge.corners)
      triples.add(row, face.face->nodes[corner], atEnd / facesAt[middle]);
  });
  for (PetscInt node : pivoting.owned)
    if (facesAt[node] == 0) triples.add(mesh.globalNode[node], mesh.globalNode[node], 1);
  return toMatrix(mesh, std::move(triples));
}

OwnedMat product(Mat a, Mat b) {
  OwnedMat result;
  check(MatMatMult(a, b, MAT_INITIAL_MATRIX, PETSC_DEFAULT, result.out()));
  return result;
}

}  // namespace

Pivoting pivotsOf(const mesh::Mesh& mesh, const NodeExchange& exchange, const Basis& basis,
                  const Sums& sums) {
  Pivoting found{{}, std::vector<double>(mesh.localNodes(), 0.0)};
  for (PetscInt node = 0; node < mesh.localNodes(); ++node) {
    if (basis.dropped[node] || basis.whole[node] == 0) continue;
    found.ratio[node] = sums.weight[node] / sums.slave[node];
    if (node < mesh.ownedNodes && exchange.primary(node) == mesh.globalNode[node])
      found.owned.push_back(node);
  }
  return found;
}

Matrices matricesOf(const mesh::Mesh& mesh, const NodeExchange& exchange,
                    const std::vector<CoveredFace>& faces, const Basis& basis,
                    const Pivoting& pivoting, Sums& sums) {
  const OwnedMat edges = edgeMatrix(mesh, exchange, faces, basis, pivoting, [](double alpha) {
    return std::array{1 - 2 * alpha, alpha};
  });
  //   P = E D⁻¹ (M − B), where ũ = u at the nodes of E that are no pivots
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    if (pivoting.ratio[node] == 0)
      sums.masters.add(mesh.globalNode[node], mesh.globalNode[node], 1);
  const OwnedMat conditions = toMatrix(mesh, std::move(sums.masters));
  std::vector<double> divisors = sums.slave;
  for (std::size_t i = 0; i < divisors.size(); ++i)
    if (pivoting.ratio[i] == 0) divisors[i] = 1;
  scale(mesh, conditions, inverted(divisors), false);
  Matrices result;
  result.masters = product(edges, conditions);
  //   G = E W/D
  check(MatDuplicate(edges, MAT_COPY_VALUES, result.jumps.out()));
  scale(mesh, result.jumps, pivoting.ratio, true);
  //   G⁻¹ = D/W E⁻¹
  result.jumpsOf = edgeMatrix(mesh, exchange, faces, basis, pivoting, [](double alpha) {
    return std::array{1 / (1 - 2 * alpha), -alpha / (1 - 2 * alpha)};
  });
  std::vector<double> isPivot;
  for (double ratio : pivoting.ratio) isPivot.push_back(ratio != 0);
  scale(mesh, result.jumpsOf, isPivot, true);
  scale(mesh, result.jumpsOf, inverted(pivoting.ratio), false);
  const auto weights = inverted(sums.weight);
  const OwnedMat convected = toMatrix(mesh, std::move(sums.convected));
  scale(mesh, convected, weights, false);
  result.convected = product(result.jumps, convected);
  result.parts = toMatrix(mesh, std::move(sums.parts), mesh.parts);
  result.bodies = toMatrix(mesh, std::move(sums.bodies), mesh.bodies.size());
  for (Mat shares : {result.parts.get(), result.bodies.get()}) scale(mesh, shares, weights, false);
  return result;
}

}  // namespace squeal::coupling
