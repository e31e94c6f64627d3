// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Serialisation of dense matrices, eigenpairs and complex vectors for checkpoints.
#include <memory>

#include "algebra/linalg/complexvector.hpp"
#include "algebra/linalg/dense.hpp"
#include "algebra/linalg/quadratic.hpp"
#include "base/checkpoint/archive.hpp"

namespace squeal::linalg {

/// Not collective. Writes or reads a matrix.
template <class Scalar>
void fields(Stream& stream, Dense<Scalar>& matrix) {
  PetscInt rows = matrix.rows(), columns = matrix.columns();
  stream(rows, columns);
  if (stream.reads()) matrix = Dense<Scalar>(rows, columns);
  stream.raw(matrix.data(), matrix.size() * sizeof(Scalar));
}

/// Not collective. Writes or reads a pair.
void fields(Stream& stream, DensePair& pair);

/// Not collective. Writes a matrix without copying its entries: the stream borrows them, and shares
/// `owner` so that they stay valid. The matrix is read back as a DenseMatrix.
void borrow(Stream& stream, const DenseView& matrix, std::shared_ptr<const void> owner = {});

/// Collective. Writes both parts of the vector, or reads them back with their original layout.
void serialise(checkpoint::Archive& archive, ComplexVector& vector);

}  // namespace squeal::linalg
