// SPDX-License-Identifier: BSD-2-Clause
#include "model/coupling/mortar_matrices.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "base/petsc/arrays.hpp"

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

/// Calls action(face, edge, middle) for each edge of each face whose mid-edge node is a pivot
/// combined with the ends; `middle` is its local number.
template <class Action>
void forEachEdge(const std::vector<CoveredFace>& faces, const SlaveBasis& basis,
                 const Pivoting& pivoting, const Action& action) {
  for (const auto& face : faces)
    for (const auto& edge : face.type->edges) {
      const PetscInt middle = face.local[edge.node];
      if (basis.alpha[middle] > 0 && pivoting.ratio[middle] != 0) action(face, edge, middle);
    }
}

/// Collective. Returns the number of faces of all ranks at each mid-edge node, [local node].
std::vector<double> facesAtEdges(const mesh::Mesh& mesh, const NodeExchange& exchange,
                                 const std::vector<CoveredFace>& faces, const SlaveBasis& basis,
                                 const Pivoting& pivoting) {
  std::vector<double> count(mesh.localNodes(), 0.0);
  forEachEdge(faces, basis, pivoting,
              [&](const auto&, const auto&, PetscInt middle) { ++count[middle]; });
  exchange.sum(count);
  return count;
}

/// Collective. Returns the matrix with the rows
///   1 on the diagonal of a pivot at a corner,   (middle, end, end) of a pivot within an edge.
OwnedMat edgeMatrix(const mesh::Mesh& mesh, const NodeExchange& exchange,
                    const std::vector<CoveredFace>& faces, const SlaveBasis& basis,
                    const Pivoting& pivoting,
                    const std::function<std::array<double, 2>(double alpha)>& middleAndEnd) {
  const auto facesAt =
      facesAtEdges(mesh, exchange, faces, basis, pivoting);  // faces that contribute to one row
  Triples triples;
  forEachEdge(faces, basis, pivoting, [&](const auto& face, const auto& edge, PetscInt middle) {
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

/// One list for each Cartesian component, [local node].
using Components = std::array<std::vector<double>, 3>;

/// Collective. Returns Σ_a α (x_a − x_e) at the edges e, summed over their faces.
Components bowsOf(const mesh::Mesh& mesh, const NodeExchange& exchange,
                  const std::vector<CoveredFace>& faces, const SlaveBasis& basis,
                  const Pivoting& pivoting) {
  Components bow;
  for (auto& values : bow) values.resize(mesh.localNodes());
  forEachEdge(faces, basis, pivoting, [&](const auto& face, const auto& edge, PetscInt middle) {
    const auto& x = face.face->points;
    for (std::size_t d = 0; d < 3; ++d)
      for (int corner : edge.corners)
        bow[d][middle] += basis.alpha[middle] * (x[corner][d] - x[edge.node][d]);
  });
  for (auto& values : bow) exchange.sum(values);
  return bow;
}

/// Collective. Returns SlaveNode::offset of the pivots of this rank, from means `bow` over the
/// faces of each edge. With ũ = x_j + m_j at the pivots, m_j = D_j⁻¹ Sums::offset, and x_a − x_e of
/// the face at the edge e,
///   Σ P_il x_l − x_i = Σ_j E_ij m_j + Σ_a α (x_a − x_e).
std::vector<Point> offsetsOf(const mesh::Mesh& mesh, const Pivoting& pivoting, const Sums& sums,
                             const Components& bow, Mat edges) {
  std::vector<Point> offsets(pivoting.owned.size());
  OwnedVec move, combined;
  check(VecCreateMPI(mesh.comm, mesh.ownedNodes, PETSC_DETERMINE, move.out()));
  check(VecDuplicate(move, combined.out()));
  for (std::size_t d = 0; d < 3; ++d) {
    check(VecSet(move, 0));
    {
      const WriteArray values(move);
      for (PetscInt node : pivoting.owned) values[node] = sums.offset[d][node] / sums.slave[node];
    }
    check(MatMult(edges, move, combined));
    const ReadArray values(combined);
    for (std::size_t i = 0; i < offsets.size(); ++i)
      offsets[i][d] = values[pivoting.owned[i]] + bow[d][pivoting.owned[i]];
  }
  return offsets;
}

}  // namespace

Pivoting pivotsOf(const mesh::Mesh& mesh, const NodeExchange& exchange, const SlaveBasis& basis,
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
                    const std::vector<CoveredFace>& faces, const SlaveBasis& basis,
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
  const auto facesAt = facesAtEdges(mesh, exchange, faces, basis, pivoting);
  auto bow = bowsOf(mesh, exchange, faces, basis, pivoting);
  for (auto& values : bow)
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = facesAt[i] > 0 ? values[i] / facesAt[i] : 0;
  result.offsets = offsetsOf(mesh, pivoting, sums, bow, edges);
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
