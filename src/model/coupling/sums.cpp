// SPDX-License-Identifier: BSD-2-Clause
#include "model/coupling/sums.hpp"

#include <map>

#include "model/mortar/dual.hpp"

namespace squeal::coupling {
namespace {

using mesh::Point;
using mortar::FaceTerms;
using mortar::MasterTerms;
using mortar::Pivots;

/// Adds factor · (to − from) to the offset of a node.
void addOffset(PetscInt local, double factor, const Point& from, const Point& to, Sums& sums) {
  for (std::size_t d = 0; d < 3; ++d) sums.offset[d][local] += factor * (to[d] - from[d]);
}

/// Adds the rows of M that belong to one master face.
void addMaster(const Pivots& pivots, const CoveredFace& face, const MasterTerms& terms,
               Sums& sums) {
  const Face& master = *face.masters[terms.face];
  for (std::size_t p = 0; p < pivots.nodes.size(); ++p) {
    const int pivot = pivots.nodes[p];
    const PetscInt row = face.face->nodes[pivot];
    std::map<int, double> parts;
    double all = 0;
    for (std::size_t l = 0; l < master.nodes.size(); ++l) {
      const double value = terms.values(p, l);
      sums.masters.add(row, master.nodes[l], value);
      addOffset(face.local[pivot], value, face.face->points[pivot], master.points[l], sums);
      parts[master.parts[l]] += value;
      all += value;
      if (!terms.convected.empty()) sums.convected.add(row, master.nodes[l], terms.convected(p, l));
    }
    for (const auto& [part, value] : parts) sums.parts.add(row, part, value);
    sums.bodies.add(row, master.body, all);
  }
}

void addFace(const CoveredFace& face, const SlaveBasis& basis, Sums& sums) {
  const Pivots kept = pivots(*face.type, mortar::Multiplier::nodes, basis.droppedOf(face));
  const FaceTerms terms = integrate(face.moments, basis.alphaOf(face), kept);
  sums.sliverFaces += !terms.dual;
  for (std::size_t p = 0; p < kept.nodes.size(); ++p) {
    const PetscInt local = face.local[kept.nodes[p]], row = face.face->nodes[kept.nodes[p]];
    sums.slave[local] += terms.slave[p], sums.weight[local] += terms.weight[p];
    sums.gap[local] += terms.gap[p];
    for (std::size_t o = 0; o < kept.others.size(); ++o) {
      sums.masters.add(row, face.face->nodes[kept.others[o]], -terms.others(p, o));
      addOffset(local, -terms.others(p, o), face.face->points[kept.nodes[p]],
                face.face->points[kept.others[o]], sums);
    }
  }
  for (const auto& master : terms.masters) addMaster(kept, face, master, sums);
}

}  // namespace

OwnedMat toMatrix(const mesh::Mesh& mesh, Triples triples, PetscInt columns) {
  const bool byNodes = columns == PETSC_DETERMINE;
  OwnedMat matrix;
  check(MatCreate(mesh.comm, matrix.out()));
  check(MatSetSizes(matrix, mesh.ownedNodes, byNodes ? mesh.ownedNodes : PETSC_DECIDE,
                    PETSC_DETERMINE, columns));
  check(MatSetType(matrix, MATAIJ));
  // This accepts indices of rows of any rank, and may change them.
  check(MatSetPreallocationCOO(matrix, triples.row.size(), triples.row.data(),
                               triples.column.data()));
  check(MatSetValuesCOO(matrix, triples.value.data(), ADD_VALUES));
  return matrix;
}

Sums sumFaces(const mesh::Mesh& mesh, const NodeExchange& exchange,
              const std::vector<CoveredFace>& faces, const SlaveBasis& basis) {
  Sums sums;
  const std::vector<std::vector<double>*> all{&sums.slave,     &sums.weight,    &sums.gap,
                                              &sums.offset[0], &sums.offset[1], &sums.offset[2]};
  for (auto* values : all) values->resize(mesh.localNodes());
  for (const auto& face : faces)
    if (face.moments.covered > 0) addFace(face, basis, sums);
  for (auto* values : all) exchange.sum(*values);
  return sums;
}

}  // namespace squeal::coupling
