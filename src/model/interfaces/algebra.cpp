// SPDX-License-Identifier: BSD-2-Clause
#include "model/interfaces/algebra.hpp"

#include <algorithm>

#include "base/petsc/check.hpp"

namespace squeal::interfaces {

OwnedMat nodalMatrix(const mesh::Mesh& mesh, PetscInt blocksPerRow) {
  OwnedMat matrix;
  const PetscInt owned = mesh.dimension * mesh.ownedNodes, entries = blocksPerRow * mesh.dimension;
  check(MatCreateAIJ(mesh.comm, owned, owned, PETSC_DETERMINE, PETSC_DETERMINE, entries, nullptr,
                     entries, nullptr, matrix.out()));
  return matrix;
}

OwnedMat nodalMatrix(const mesh::Mesh& mesh, const std::vector<PetscInt>& blocks) {
  OwnedMat matrix;
  const PetscInt owned = mesh.dimension * mesh.ownedNodes;
  std::vector<PetscInt> own, others;  // entries of a row in the columns of this rank and of others
  for (PetscInt count : blocks)
    for (int d = 0; d < mesh.dimension; ++d) {
      own.push_back(mesh.dimension * std::min(count, mesh.ownedNodes));
      others.push_back(mesh.dimension * (count - 1));  // one block belongs to the node itself
    }
  check(MatCreateAIJ(mesh.comm, owned, owned, PETSC_DETERMINE, PETSC_DETERMINE, 0, own.data(), 0,
                     others.data(), matrix.out()));
  return matrix;
}

void assembled(Mat matrix) {
  check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
}

void setBlock(Mat matrix, int dimension, PetscInt rowNode, PetscInt columnNode,
              const std::vector<double>& block) {
  std::vector<PetscInt> rows, columns;
  for (int d = 0; d < dimension; ++d)
    rows.push_back(dimension * rowNode + d), columns.push_back(dimension * columnNode + d);
  check(MatSetValues(matrix, dimension, rows.data(), dimension, columns.data(), block.data(),
                     INSERT_VALUES));
}

void setDiagonal(Mat matrix, int dimension, PetscInt node) {
  for (int d = 0; d < dimension; ++d)
    check(MatSetValue(matrix, dimension * node + d, dimension * node + d, 1, INSERT_VALUES));
}

std::vector<double> outer(const Point& a, const Point& b, int dimension, double factor) {
  std::vector<double> block;
  for (int i = 0; i < dimension; ++i)
    for (int j = 0; j < dimension; ++j) block.push_back(factor * a[i] * b[j]);
  return block;
}

std::vector<double> identity(int dimension, double factor) {
  std::vector<double> block(dimension * dimension, 0.0);
  for (int d = 0; d < dimension; ++d) block[d * dimension + d] = factor;
  return block;
}

OwnedMat product(Mat a, Mat b) {
  OwnedMat result;
  check(MatMatMult(a, b, MAT_INITIAL_MATRIX, PETSC_DEFAULT, result.out()));
  return result;
}

}  // namespace squeal::interfaces
