// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/linalg/serialization.hpp"

#include <span>
#include <utility>

namespace squeal::linalg {

void fields(Stream& stream, DensePair& pair) {
  // This lists all members: a new one does not compile until it is added here.
  auto& [s, q, left] = pair;
  stream(s, q, left);
}

void borrow(Stream& stream, const DenseView& matrix, std::shared_ptr<const void> owner) {
  PetscInt rows = matrix.rows(), columns = matrix.columns();
  stream(rows, columns);
  const auto entries = matrix.entries();
  stream.borrow({reinterpret_cast<const char*>(entries.data()), entries.size_bytes()},
                std::move(owner));
}

void serialise(checkpoint::Archive& archive, ComplexVector& vector) {
  auto& [real, imaginary] = vector;
  archive.vector(real);
  archive.vector(imaginary);
}

}  // namespace squeal::linalg
