// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Products, orthonormalisation and eigenvectors of small dense complex matrices, by BLAS and
/// LAPACK. Not collective.
#include "algebra/linalg/dense.hpp"

namespace squeal::linalg {

/// Returns A X, or Aᵀ X if `transposed`, of a real square matrix A; zero for an empty A.
ComplexMatrix product(const DenseMatrix& a, const ComplexMatrix& x, bool transposed = false);
/// Returns X C.
ComplexMatrix product(const ComplexMatrix& x, const ComplexMatrix& c);
/// Returns Xᴴ Y.
ComplexMatrix adjointProduct(const ComplexMatrix& x, const ComplexMatrix& y);

/// Replaces the columns, at most as many as rows, by orthonormal ones whose span contains theirs
/// (Householder). No column may be zero or have infinite entries. Throws Error if LAPACK fails.
void orthonormalise(ComplexMatrix& x);

/// All eigenvalues of a matrix with their vectors, A X = X diag(value), Yᴴ A = diag(value) Yᴴ.
struct ComplexEigen {
  std::vector<Complex> value;
  ComplexMatrix right, left;  ///< columns of 2-norm 1
};

/// Returns the eigenvalues and vectors of a square matrix, unsorted. Throws Error if LAPACK fails.
ComplexEigen eigen(ComplexMatrix a);

}  // namespace squeal::linalg
