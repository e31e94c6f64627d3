// SPDX-License-Identifier: BSD-2-Clause
#include "model/coupling/coupling.hpp"

#include <algorithm>
#include <cmath>

#include "base/system/mpi.hpp"
#include "model/coupling/covered.hpp"
#include "model/coupling/mortar_matrices.hpp"
#include "model/coupling/periodic.hpp"
#include "model/coupling/sums.hpp"

namespace squeal::coupling {
namespace {

std::vector<Weight> rowOf(Mat matrix, PetscInt row) {
  PetscInt count = 0;
  const PetscInt* columns = nullptr;
  const PetscScalar* values = nullptr;
  std::vector<Weight> weights;
  check(MatGetRow(matrix, row, &count, &columns, &values));
  for (PetscInt k = 0; k < count; ++k)
    if (values[k] != 0) weights.push_back({columns[k], values[k]});
  check(MatRestoreRow(matrix, row, &count, &columns, &values));
  return weights;
}

std::vector<SlaveNode> slaveNodes(const mesh::Mesh& mesh, const SlaveBasis& basis,
                                  const Pivoting& pivoting, const Sums& sums,
                                  const Matrices& matrices) {
  std::vector<SlaveNode> nodes;
  for (std::size_t i = 0; i < pivoting.owned.size(); ++i) {
    const PetscInt local = pivoting.owned[i], row = mesh.globalNode[local];
    SlaveNode node;
    node.node = local;
    node.masters = rowOf(matrices.masters, row);
    node.jumps = rowOf(matrices.jumps, row), node.jumpsOf = rowOf(matrices.jumpsOf, row);
    node.convected = rowOf(matrices.convected, row);
    for (const auto& [part, share] : rowOf(matrices.parts, row))
      node.masterParts.push_back({int(part), share});
    double most = 0;
    for (const auto& [body, share] : rowOf(matrices.bodies, row))
      if (share > most) most = share, node.masterBody = body;
    node.area = sums.weight[local], node.wholeArea = basis.whole[local];
    node.gap = sums.gap[local] / sums.weight[local];
    node.offset = matrices.offsets[i];
    nodes.push_back(std::move(node));
  }
  return nodes;
}

SideReport sideReport(MPI_Comm comm, const std::vector<Face>& faces,
                      const std::vector<bool>& isNear) {
  double sums[4] = {0, 0, 0, 0};
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const double area = areaOf(faces[i]);
    sums[0] += 1, sums[1] += area;
    if (isNear[i]) sums[2] += 1, sums[3] += area;
  }
  mpi::reduce<double>(comm, sums, MPI_SUM);
  return {PetscInt(sums[0]), PetscInt(sums[2]), sums[1], sums[3]};
}

/// Collective. Returns for each face whether a face of the other side is near.
std::vector<bool> nearOthers(MPI_Comm comm, const std::vector<Face>& faces,
                             const std::vector<Face>& others, double searchDistance) {
  std::vector<bool> isNear;
  const auto found = candidates(comm, faces, others, searchDistances(faces, searchDistance));
  for (const auto& list : found.ofSlave) isNear.push_back(!list.empty());
  return isNear;
}

}  // namespace

Coupling couple(const mesh::Mesh& mesh, const NodeExchange& exchange, const Interface& interface,
                const BodyVelocity& velocity, const std::vector<unsigned char>& excluded) {
  const Surfaces surfaces =
      surfacesOf(mesh, exchange, interface.slave, interface.master, interface.searchDistance);
  const auto faces = cover(mesh.comm, surfaces, interface.slave, velocity);
  const SlaveBasis basis = chooseBasis(mesh, exchange, faces, excluded);
  Sums sums = sumFaces(mesh, exchange, faces, basis);
  const Pivoting pivoting = pivotsOf(mesh, exchange, basis, sums);
  const Matrices matrices = matricesOf(mesh, exchange, faces, basis, pivoting, sums);

  Coupling coupling;
  coupling.nodes = slaveNodes(mesh, basis, pivoting, sums, matrices);
  std::vector<bool> isNear;
  for (const auto& list : surfaces.candidates.ofSlave) isNear.push_back(!list.empty());
  coupling.slave = sideReport(mesh.comm, surfaces.slaves, isNear);
  coupling.master = sideReport(
      mesh.comm, surfaces.masters,
      nearOthers(mesh.comm, surfaces.masters, repeated(surfaces.slaves, surfaces.translations),
                 interface.searchDistance));
  coupling.droppedNodes = basis.droppedNodes;
  for (const PetscInt node : basis.droppedOwned)
    if (excluded[node]) coupling.excluded.push_back(node);
  coupling.sliverFaces = sums.sliverFaces;
  for (const auto& face : faces) {
    coupling.coveredArea += face.moments.covered;
    coupling.largestGap = std::max(coupling.largestGap, face.moments.largestGap);
  }
  coupling.coveredArea = mpi::sum(mesh.comm, coupling.coveredArea);
  coupling.sliverFaces = mpi::sum(mesh.comm, coupling.sliverFaces);
  coupling.largestGap = mpi::max(mesh.comm, coupling.largestGap);
  return coupling;
}

bool masterIsFiner(const mesh::Mesh& mesh, const Interface& interface) {
  const auto slaves = mortar::facesOf(mesh, interface.slave),
             masters = mortar::facesOf(mesh, interface.master);
  const auto ways = translations(mesh, slaves, masters);
  const auto mean = [&](const std::vector<Face>& faces, const std::vector<Face>& others) {
    const auto report =
        sideReport(mesh.comm, faces,
                   nearOthers(mesh.comm, faces, repeated(others, ways), interface.searchDistance));
    return report.nearFaces > 0 ? report.nearArea / report.nearFaces : INFINITY;
  };
  // With about equal cells, prefer the slave that does not overhang its master, unlike a disc.
  // Round-off must not decide about faces in a ratio of 4 to 5.
  return mean(masters, slaves) < (1 - 1e-6) * 0.8 * mean(slaves, masters);
}

}  // namespace squeal::coupling
