// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Sums of the terms of all slave faces at the nodes of the mesh.
#include <array>
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/coupling/covered.hpp"
#include "model/elasticity/assembly.hpp"

namespace squeal::coupling {

using elasticity::Triples;

/// Collective. Returns the matrix of the triples of all ranks, with a row per node and `columns`
/// columns (default: one per node). A rank may have triples of any row. Triples with equal indices
/// are added.
OwnedMat toMatrix(const mesh::Mesh& mesh, Triples triples, PetscInt columns = PETSC_DETERMINE);

/// The sums over the faces of this rank. B, C, D, G, M and W are those of mortar::FaceTerms. Rows
/// and columns are the numbers of nodes, with primaries in place of images.
struct Sums {
  Triples masters;                         ///< M − B, [pivot][node of the master or dropped node]
  Triples convected;                       ///< C
  Triples parts;                           ///< M by connected parts of the master
  Triples bodies;                          ///< M by bodies of the master
  std::vector<double> slave, weight, gap;  ///< D, W, G, [local node], summed over all ranks
  /// Σ M_jl (x_l − x_j) − Σ B_jo (x_o − x_j), [component][local node], summed over all ranks;
  /// images have their own positions
  std::array<std::vector<double>, 3> offset;
  PetscInt sliverFaces = 0;  ///< faces without dual functions (FaceTerms::dual)
};

/// Collective. Returns the sums.
Sums sumFaces(const mesh::Mesh& mesh, const NodeExchange& exchange,
              const std::vector<CoveredFace>& faces, const SlaveBasis& basis);

}  // namespace squeal::coupling
