// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// N×N matrices that consist of a block per pair of nodes, for the contact.
#include <string>
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

using mesh::Point;

/// Collective. Returns an N×N matrix with entries reserved for `blocksPerRow` dimension×dimension
/// blocks per row of blocks.
OwnedMat nodalMatrix(const mesh::Mesh& mesh, PetscInt blocksPerRow);
/// Collective. Returns an N×N matrix with entries reserved for `blocks`[owned node] blocks in the
/// rows of a node.
OwnedMat nodalMatrix(const mesh::Mesh& mesh, const std::vector<PetscInt>& blocks);
/// Collective. Assembles the matrix after values have been set.
void assembled(Mat matrix);
/// Not collective. Sets the block of two global nodes, row-major. Zeros are stored as entries, so
/// friction changes only values, not the sparsity pattern.
void setBlock(Mat matrix, int dimension, PetscInt rowNode, PetscInt columnNode,
              const std::vector<double>& block);
/// Not collective. Sets the diagonal of the block of a global node to one.
void setDiagonal(Mat matrix, int dimension, PetscInt node);
/// Returns factor · a bᵀ, dimension × dimension, row-major.
std::vector<double> outer(const Point& a, const Point& b, int dimension, double factor = 1);
/// Returns factor times the unit matrix, dimension × dimension.
std::vector<double> identity(int dimension, double factor);

using mesh::text;

/// Collective. Returns the product of two matrices.
OwnedMat product(Mat a, Mat b);

}  // namespace squeal::interfaces
