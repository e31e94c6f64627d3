// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Dense matrices, eigenpairs and complex vectors are written to checkpoints and read back.
#include <memory>

#include "algebra/linalg/complexvector.hpp"
#include "algebra/linalg/dense.hpp"
#include "algebra/linalg/quadratic.hpp"
#include "base/checkpoint/archive.hpp"

namespace squeal::linalg {

/// Not collective. Writes a matrix, or sets it.
template <class Scalar>
void fields(Stream& stream, Dense<Scalar>& matrix) {
  PetscInt rows = matrix.rows(), columns = matrix.columns();
  stream(rows, columns);
  if (stream.reads()) matrix = Dense<Scalar>(rows, columns);
  stream.raw(matrix.data(), matrix.size() * sizeof(Scalar));
}

/// Not collective. Writes a pair, or sets it.
void fields(Stream& stream, DensePair& pair);

/// Not collective. Writes a matrix without a copy of its entries, which are borrowed; `owner` is
/// kept during the life of the stream. It is read as a DenseMatrix.
void borrow(Stream& stream, const DenseView& matrix, std::shared_ptr<const void> owner = {});

/// Collective. Writes both parts, or makes them with the layout that they had.
void exchange(checkpoint::Archive& archive, ComplexVector& vector);

}  // namespace squeal::linalg
