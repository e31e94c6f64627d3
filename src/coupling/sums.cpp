#include "coupling/sums.hpp"

#include <map>

#include "mortar/dual.hpp"

namespace squeal::coupling {
namespace {

using mortar::FaceTerms;
using mortar::MasterTerms;
using mortar::Pivots;

/// Adds the rows of M that belong to one master face.
void addMaster(const Pivots& pivots, const CoveredFace& face, const MasterTerms& terms,
               Sums& sums) {
  const Face& master = *face.masters[terms.face];
  for (std::size_t p = 0; p < pivots.nodes.size(); ++p) {
    const PetscInt row = face.face->nodes[pivots.nodes[p]];
    std::map<int, double> parts;
    double all = 0;
    for (std::size_t l = 0; l < master.nodes.size(); ++l) {
      const double value = terms.values(p, l);
      sums.masters.add(row, master.nodes[l], value);
      parts[master.parts[l]] += value;
      all += value;
      if (!terms.convected.empty()) sums.convected.add(row, master.nodes[l], terms.convected(p, l));
    }
    for (const auto& [part, value] : parts) sums.parts.add(row, part, value);
    sums.bodies.add(row, master.body, all);
  }
}

void addFace(const CoveredFace& face, const Basis& basis, Sums& sums) {
  const Pivots kept = pivots(*face.type, mortar::Multiplier::nodes, basis.droppedOf(face));
  const FaceTerms terms = integrate(face.moments, basis.alphaOf(face), kept);
  sums.sliverFaces += !terms.dual;
  for (std::size_t p = 0; p < kept.nodes.size(); ++p) {
    const PetscInt local = face.local[kept.nodes[p]], row = face.face->nodes[kept.nodes[p]];
    sums.slave[local] += terms.slave[p], sums.weight[local] += terms.weight[p];
    sums.gap[local] += terms.gap[p];
    for (std::size_t o = 0; o < kept.others.size(); ++o)
      sums.masters.add(row, face.face->nodes[kept.others[o]], -terms.others(p, o));
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
  // This takes the indices of any rank's rows, and may change them.
  check(MatSetPreallocationCOO(matrix, triples.row.size(), triples.row.data(),
                               triples.column.data()));
  check(MatSetValuesCOO(matrix, triples.value.data(), ADD_VALUES));
  return matrix;
}

Sums sumFaces(const mesh::Mesh& mesh, const NodeExchange& exchange,
              const std::vector<CoveredFace>& faces, const Basis& basis) {
  Sums sums;
  for (auto* values : {&sums.slave, &sums.weight, &sums.gap}) values->resize(mesh.localNodes());
  for (const auto& face : faces)
    if (face.moments.covered > 0) addFace(face, basis, sums);
  for (auto* values : {&sums.slave, &sums.weight, &sums.gap}) exchange.sum(*values);
  return sums;
}

}  // namespace squeal::coupling
