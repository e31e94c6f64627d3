#pragma once
/// This file adds what couples single slave faces, by nodes of the mesh.
#include <vector>

#include "coupling/covered.hpp"
#include "petsc/owned.hpp"

namespace squeal::coupling {

/// A matrix with a row per node of the mesh, as triples. Those of one place are added.
struct Triples {
  std::vector<PetscInt> row, column;
  std::vector<PetscScalar> value;
  void add(PetscInt i, PetscInt j, double entry) {
    row.push_back(i), column.push_back(j), value.push_back(entry);
  }
};

/// Collective. Returns the matrix of the triples of all ranks, which may be of any rows, with
/// `columns` columns, or one per node.
OwnedMat toMatrix(const mesh::Mesh& mesh, Triples triples, PetscInt columns = PETSC_DETERMINE);

/// The sums over the faces of this rank. Rows and columns are primaries.
struct Sums {
  Triples masters;                         ///< M − B, [pivot][node of the master or dropped node]
  Triples convected;                       ///< C
  Triples parts;                           ///< M by connected parts of the master
  Triples bodies;                          ///< M by bodies of the master
  std::vector<double> slave, weight, gap;  ///< D, W, G, [local node], over all ranks
  PetscInt sliverFaces = 0;                ///< FaceTerms without dual functions
};

/// Collective. Returns the sums.
Sums sumFaces(const mesh::Mesh& mesh, const NodeExchange& exchange,
              const std::vector<CoveredFace>& faces, const Basis& basis);

}  // namespace squeal::coupling
