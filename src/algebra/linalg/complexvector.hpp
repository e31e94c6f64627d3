// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Complex vectors for a PETSc that is built with real scalars.
#include "algebra/linalg/complex.hpp"
#include "base/petsc/owned.hpp"

namespace squeal::linalg {

/// A complex vector, stored as two real vectors of the same layout, which it owns.
struct ComplexVector {
  OwnedVec real, imaginary;

  /// Collective. Returns a vector of zeros, laid out like `vector`.
  static ComplexVector like(Vec vector);
  /// Collective. Returns a copy of the two parts; the arguments are borrowed.
  static ComplexVector copied(Vec real, Vec imaginary);
};

/// Collective. Returns uᴴ v.
Complex dot(const ComplexVector& u, const ComplexVector& v);
/// Collective. Adds a u to v.
void add(ComplexVector& v, Complex a, const ComplexVector& u);
/// Collective. Returns A u, or Aᵀ u if `transposed`.
ComplexVector product(Mat a, const ComplexVector& u, bool transposed = false);
/// Collective. Returns the 2-norm of u.
double length(const ComplexVector& u);

}  // namespace squeal::linalg
