// SPDX-License-Identifier: BSD-2-Clause
#include "model/contact/transformation.hpp"

#include <algorithm>

#include "base/petsc/matrix.hpp"
#include "base/system/mpi.hpp"
#include "model/interfaces/algebra.hpp"

namespace squeal::contact {

ReleasedUnknowns compared(const Transformation& open, const Transformation& closed) {
  ReleasedUnknowns found;
  for (std::size_t k = 0; k < open.rows.size(); ++k) {
    const bool isShared = std::ranges::binary_search(closed.rows, open.rows[k]);
    (isShared ? found.shared : found.released).push_back(k);
  }
  return found;
}

Transformation transformationOf(const mesh::Mesh& mesh, const interfaces::Interfaces& all,
                                const Kinematics& kinematics, const ActiveSet& set) {
  const int dimension = mesh.dimension;
  const auto& nodes = all.nodes;
  Mask unknown = kinematics.free;
  const auto gapAt = [&](const interfaces::ContactNode& node) {
    return dimension * (node.node + 1) - 1;
  };
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (set.closed[i]) unknown[gapAt(nodes[i])] = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].role == interfaces::Role::sticking)
      for (PetscInt t = 1; t < dimension; ++t)
        unknown[gapAt(nodes[i]) - t] = !set.released.empty() && set.released[i];

  Transformation result;
  result.ownedColumns = std::count(unknown.begin(), unknown.end(), 1);
  result.columns = mpi::sum(mesh.comm, result.ownedColumns);
  std::vector<PetscInt> column(unknown.size(), -1);
  PetscInt next = mpi::sumBefore(mesh.comm, result.ownedColumns);
  for (std::size_t i = 0; i < unknown.size(); ++i)
    if (unknown[i]) {
      column[i] = next++;
      result.rows.push_back(i);
    }
  for (const auto& node : nodes) result.gapColumn.push_back(column[gapAt(node)]);

  const PetscInt owned = dimension * mesh.ownedNodes, first = dimension * mesh.firstNode;
  check(MatCreateAIJ(mesh.comm, owned, result.ownedColumns, PETSC_DETERMINE, PETSC_DETERMINE, 1,
                     nullptr, 0, nullptr, result.selection.out()));
  for (PetscInt i = 0; i < owned; ++i)
    if (column[i] >= 0)
      check(MatSetValue(result.selection, first + i, column[i], 1, INSERT_VALUES));
  interfaces::assembled(result.selection);
  std::vector<PetscInt> unknowns;
  for (const PetscInt row : result.rows) unknowns.push_back(first + row);
  OwnedIS columns;
  check(ISCreateGeneral(mesh.comm, unknowns.size(), unknowns.data(), PETSC_COPY_VALUES,
                        columns.out()));
  check(MatCreateSubMatrix(kinematics.matrix, ownRows(kinematics.matrix), columns,
                           MAT_INITIAL_MATRIX, result.trial.out()));
  check(MatSetBlockSizes(result.trial, dimension,
                         1));  // gives T x the block size of a nodal vector

  return result;
}

}  // namespace squeal::contact
